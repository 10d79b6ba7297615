// One closed form or limit per model and part, beyond the contract tests.
#include <catch2/catch.hpp>

#include "tests/materials/model_cases.h"

using namespace firn;
using namespace firn::test;

namespace {

using M3 = Matrix<double, 3>;

M3 diagonal(double a, double b, double c) {
  return M3::diagonal({a, b, c});
}

PlasticPoint<double, 3> crushed(double s) {
  return {M3::identity(), M3::scaled_identity(s)};
}

}  // namespace

TEST_CASE("neo-Hookean's simple shear has tau_12 = mu gamma and a Poynting stress mu gamma^2",
          "[materials]") {
  const NeoHookean model{{1000, {2, 3}}};
  ElasticPoint<double, 3> p{M3{{{1, 0.5, 0}, {0, 1, 0}, {0, 0, 1}}}};
  const M3 tau = model.update(p, 0.0).tau;
  CHECK(tau(0, 1) == 2 * 0.5);
  CHECK(tau(0, 0) == 2 * 0.25);
  CHECK(tau(1, 1) == 0);
}

TEST_CASE("neo-Hookean's wave modulus is the closed form when the stretch lies along an axis",
          "[materials]") {
  const NeoHookean model{{1000, {2, 3}}};
  ElasticPoint<double, 3> p{diagonal(1.5, 0.8, 0.9)};
  const double J = 1.5 * 0.8 * 0.9;
  CHECK(model.update(p, 0.0).wave_modulus == Approx(2 * (2.25 + 1) + 3 * (1 - std::log(J))).epsilon(1e-14));
}

TEST_CASE("neo-Hookean and Hencky stress an inverted point like its mirror image and count it",
          "[materials]") {
  const NeoHookean neo{{1000, {2, 3}}};
  const StvkHencky hencky{{1000, {2, 3}}};
  const auto check = [](const auto& model) {
    ElasticPoint<double, 3> inverted{diagonal(1.2, 0.9, -0.7)}, mirror{diagonal(1.2, 0.9, 0.7)},
        flat{diagonal(1, 1, 0)};
    const auto a = model.update(inverted, 0.0), b = model.update(mirror, 0.0), c = model.update(flat, 0.0);
    // The same numbers but for the order of a sum.
    CHECK(largest_entry(a.tau - b.tau) < 1e-14);
    CHECK(a.capped == 1);
    CHECK(b.capped == 0);
    CHECK(c.capped == 1);
    CHECK(c.tau(2, 2) < -60);  // pushes the flat point open: ln of the floor times lam at least
  };
  check(neo);
  check(hencky);
}

TEST_CASE("fixed corotated restores an inverted point", "[materials]") {
  const FixedCorotated model{{1000, {2, 3}}};
  ElasticPoint<double, 3> p{diagonal(1, 1, -0.5)};
  const auto r = model.update(p, 0.0);
  // tau_3 = 2 mu (s - 1) s + lam (J - 1) J with s = J = -0.5: energy falls as s grows, so P_3 = tau_3 / s <
  // 0.
  CHECK(r.tau(2, 2) == Approx(2 * 2 * 0.75 + 3 * 0.75).epsilon(1e-14));
  CHECK(r.capped == 0);
}

TEST_CASE("StVK-Hencky is linear in the logarithm of a stretch", "[materials]") {
  const StvkHencky model{{1000, {2, 3}}};
  ElasticPoint<double, 3> p{diagonal(std::exp(0.3), std::exp(-0.2), 1)};
  const M3 tau = model.update(p, 0.0).tau;
  CHECK(tau(0, 0) == Approx(4 * 0.3 + 3 * 0.1).epsilon(1e-13));
  CHECK(tau(1, 1) == Approx(4 * -0.2 + 3 * 0.1).epsilon(1e-13));
  CHECK(model.energy(p) == Approx(2 * (0.09 + 0.04) + 1.5 * 0.01).epsilon(1e-13));
}

TEST_CASE("snow crushed evenly keeps 1 - theta_c elastic and hardens by exp(xi (1 - J_P))", "[materials]") {
  const auto model = sample_model<SnowStomakhin2013>();
  PlasticPoint<double, 3> p{M3::scaled_identity(0.9), M3::identity()};
  const auto r = model.update(p, 1e-3);
  CHECK(largest_entry(p.F_E - M3::scaled_identity(0.975)) < 1e-15);
  const double J_P = std::pow(0.9 / 0.975, 3), J = std::pow(0.975, 3), factor = std::exp(10 * (1 - J_P));
  const Lame<double> m = lame(1.4e5, 0.2);
  const double tau = factor * (2 * m.mu * -0.025 * 0.975 + m.lam * (J - 1) * J);
  CHECK(r.tau(0, 0) == Approx(tau).epsilon(1e-12));
  CHECK(r.wave_modulus == Approx(factor * (2 * m.mu * 0.975 * 0.975 + m.lam * J * J)).epsilon(1e-12));
  CHECK(r.capped == 0);
}

TEST_CASE("snow's hardening stops at its cap and is counted there", "[materials]") {
  const auto model = sample_model<SnowStomakhin2013>();
  // J_P = 0.43 is where exp(10 (1 - J_P)) reaches 300.
  const auto factor = [&](double J_P) { return model.hardening.evaluate(J_P); };
  CHECK(factor(0.44).capped == 0);
  CHECK(factor(0.42).capped == 1);
  CHECK(factor(0.42).factor == Approx(300).epsilon(1e-14));
  CHECK(factor(-1e6).factor == Approx(300).epsilon(1e-14));
  PlasticPoint<double, 3> p = crushed(0.1);
  CHECK(model.update(p, 0.0).capped == 1);
}

TEST_CASE("snow without a cap still has finite moduli in float", "[materials]") {
  SnowStomakhin2013 model = sample_model<SnowStomakhin2013>();
  model.hardening.log_cap = kInfinity;
  PlasticPoint<float, 3> p{Matrix<float, 3>::scaled_identity(0.98f),
                           Matrix<float, 3>::scaled_identity(-100.0f)};
  const auto r = model.update(p, 0.0f);
  CHECK(std::isfinite(largest_entry(r.tau)));
  CHECK(std::isfinite(r.wave_modulus));
  CHECK(r.capped == 1);
}

TEST_CASE("snow spread to nothing keeps a positive wave modulus", "[materials]") {
  const auto model = sample_model<SnowStomakhin2013>();
  PlasticPoint<double, 3> p = crushed(5);
  const auto r = model.update(p, 0.0);
  CHECK(r.wave_modulus == Approx(1e-6 * model.moduli.p_wave()).epsilon(1e-14));
  CHECK(r.capped == 0);
}

TEST_CASE("snow's plastic work is the energy of the trial state less that of the projected one",
          "[materials]") {
  // Sheared beyond yield at constant J_P in 2D: (1 + a)(1 - b) with both ends clamped, moduli from J_P after.
  const auto model = sample_model<SnowStomakhin2013>();
  PlasticPoint<double, 2> p{Matrix<double, 2>::diagonal({1.02, 0.96}), Matrix<double, 2>::identity()};
  const double before = model.energy(p);
  const auto r = model.update(p, 1e-3);
  CHECK(r.dissipated > 0);
  CHECK(r.dissipated == Approx(before - model.energy(p)).epsilon(1e-10));
}
