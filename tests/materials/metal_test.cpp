// Von Mises with each hardening and rate: closed forms, limits and rates.
#include <catch2/catch.hpp>

#include "tests/materials/flow_paths.h"

using namespace firn;
using namespace firn::test;

namespace {

const ParameterValues kSoft = {
    {"density", 1000}, {"youngs_modulus", 1e6}, {"poissons_ratio", 0.3}, {"sigma_y", 1e4}, {"H", 0},
    {"eta", 100}};
const double kMu = lame(1e6, 0.3).mu;

ParameterValues with(std::string_view name, double value) {
  ParameterValues out = kSoft;
  out[std::string(name)] = value;
  return out;
}

template <int D>
double steady_shear_stress(const VonMisesLinear& metal) {
  Led<VonMisesLinear, D> led(metal);
  led.shear(0.5, 5000, 1);
  return led.response.tau(0, 1);
}

/// The equivalent stress after a pure shear by 5 % in `time` seconds.
template <class Model>
double stress_at_rate(const Model& model, double time) {
  Led<Model, 3> led(model);
  led.stretch(0.05, 500, time);
  return led.equivalent_stress();
}

}  // namespace

TEST_CASE("von Mises in steady simple shear carries sigma_y / sqrt(3)", "[materials]") {
  // The axes of F_E turn against the flow by the elastic strain, here 0.1 %: to the second order in it.
  const auto metal = make_model<VonMisesLinear>(with("sigma_y", 1e3));
  CHECK(steady_shear_stress<2>(metal) == Approx(1e3 / std::sqrt(3.0)).epsilon(1e-5));
  CHECK(steady_shear_stress<3>(metal) == Approx(1e3 / std::sqrt(3.0)).epsilon(1e-5));
}

TEST_CASE("linear hardening in pure shear is the closed form, in one step and in many", "[materials]") {
  for (const double H : {0.0, 2e5, -1e5}) {
    const auto metal = make_model<VonMisesLinear>(with("H", H));
    const double strain = 2 / std::sqrt(3.0) * 0.05;  // equivalent
    const double alpha = (3 * kMu * strain - 1e4) / (3 * kMu + H);
    for (const int steps : {1, 100}) {
      Led<VonMisesLinear, 3> led(metal);
      led.stretch(0.05, steps, 1);
      CHECK(led.point.history.alpha == Approx(alpha).epsilon(1e-11));
      CHECK(led.equivalent_stress() == Approx(1e4 + H * alpha).epsilon(1e-11));
      CHECK(led.pressure() == Approx(0).margin(1e-6));
      CHECK(determinant(led.point.F_P) == Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("unloading is elastic and leaves a permanent set", "[materials]") {
  const auto metal = make_model<VonMisesLinear>(with("H", 2e5));
  Led<VonMisesLinear, 3> led(metal);
  led.stretch(0.05, 100, 1);
  const double q = led.equivalent_stress(), alpha = led.point.history.alpha;
  led.stretch(-0.002, 10, 1);
  CHECK(led.point.history.alpha == alpha);
  CHECK(led.equivalent_stress() == Approx(q - 3 * kMu * 2 / std::sqrt(3.0) * 0.002).epsilon(1e-10));
  // Back at the length where no stress is left.
  led.stretch(-(q / (3 * kMu) * std::sqrt(3.0) / 2 - 0.002), 10, 1);
  CHECK(led.equivalent_stress() == Approx(0).margin(1e-6 * q));
}

TEMPLATE_TEST_CASE("a nonlinear hardening's step ends on its curve", "[materials]", VonMisesVoce,
                   VonMisesJohnsonCook) {
  ParameterValues values = kSoft;
  values.insert({{"saturation", 5e4}, {"exponent", 16}, {"A", 1e4}, {"B", 4e4}});
  const auto metal = make_model<TestType>(values);
  for (const double strain : {0.009, 0.02, 0.3, 3.0, 13.0})
    for (const double dt : {1e-6, 1e-3, 10.0}) {
      Led<TestType, 3> led(metal);
      led.stretch(strain, 1, dt);
      const double alpha = led.point.history.alpha;
      const double sigma = metal.flow.rate.stress(metal.flow.hardening.stress(alpha), alpha / dt).value;
      CHECK(alpha > 0);
      // Stretched by exp(13) the small stretch has lost what the long one rounds: 5e5 eps.
      CHECK(led.equivalent_stress() == Approx(sigma).epsilon(strain > 5 ? 1e-8 : 1e-10));
    }
}

TEST_CASE("a metal drawn out without end keeps finite numbers, and that is counted", "[materials]") {
  const auto metal = make_model<VonMisesLinear>(kSoft);
  auto p = metal.at_rest<float, 3>();
  float capped = 0;
  for (int n = 0; n < 400; ++n) {
    p.F_E = Matrix<float, 3>::diagonal({1.5F, 1 / 1.5F, 1.0F}) * p.F_E;
    const auto r = metal.update(p, 1e-3F);
    REQUIRE(std::isfinite(largest_entry(r.tau)));
    capped += r.capped;
  }
  CHECK(std::isfinite(determinant(p.F_P)));
  CHECK(capped > 300);
}

TEST_CASE("Voce's hardening saturates", "[materials]") {
  ParameterValues values = kSoft;
  values.insert({{"saturation", 5e4}, {"exponent", 16}});
  Led<VonMisesVoce, 3> led(make_model<VonMisesVoce>(values));
  led.stretch(2, 2000, 1);
  CHECK(led.equivalent_stress() == Approx(6e4).epsilon(1e-10));
}

TEST_CASE("rate-independent curves coincide, those with a rate come apart", "[materials]") {
  const auto steady = make_model<VonMisesLinear>(kSoft);
  const auto viscous = make_model<VonMisesPerzyna>(kSoft);
  double last = 0;
  for (const double time : {1e6, 1e3, 1.0, 1e-3, 1e-8}) {
    CHECK(stress_at_rate(steady, time) == Approx(1e4).epsilon(1e-10));
    const double q = stress_at_rate(viscous, time);
    CHECK(q > last);
    last = q;
  }
  CHECK(stress_at_rate(viscous, 1e6) == Approx(1e4).epsilon(1e-8));
  CHECK(last == Approx(3 * kMu * 2 / std::sqrt(3.0) * 0.05).epsilon(1e-3));  // elastic
}

TEST_CASE("Perzyna's viscosity leads from rate-independent to elastic", "[materials]") {
  const double elastic = 3 * kMu * 2 / std::sqrt(3.0) * 0.05;
  CHECK(stress_at_rate(make_model<VonMisesPerzyna>(with("eta", 1e-6)), 1) == Approx(1e4).epsilon(1e-6));
  CHECK(stress_at_rate(make_model<VonMisesPerzyna>(with("eta", 1e12)), 1) == Approx(elastic).epsilon(1e-5));
  // In steady flow the overstress is eta times the rate, 2/sqrt(3) 0.05 a second; the rest has died away as
  // exp(-3 mu t / eta).
  CHECK(stress_at_rate(make_model<VonMisesPerzyna>(with("eta", 1e4)), 1) ==
        Approx(1e4 + 1e4 * 2 / std::sqrt(3.0) * 0.05).epsilon(1e-6));
}

TEST_CASE("Johnson and Cook's stress grows with the logarithm of the rate", "[materials]") {
  ParameterValues values = kSoft;
  values.insert({{"A", 1e4}, {"B", 0}, {"C", 0.02}});
  const auto metal = make_model<VonMisesJohnsonCook>(values);
  const double slow = stress_at_rate(metal, 1e3);
  CHECK(slow == Approx(1e4).epsilon(1e-10));
  const double rate = 2 / std::sqrt(3.0) * 0.05 / 1e-4;
  // The last steps' plastic rate is the whole rate.
  CHECK(stress_at_rate(metal, 1e-4) == Approx(1e4 * (1 + 0.02 * std::log(rate))).epsilon(1e-6));
}
