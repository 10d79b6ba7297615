// What every model promises about its stress, whatever it is made of.
#include <catch2/catch.hpp>

#include "tests/materials/model_cases.h"

using namespace firn;
using namespace firn::test;

namespace {

constexpr int kDraws = 300;
// Round-off of a number type, with room for the few dozen operations between F and a stress.
template <class Real>
constexpr double kRound = 60 * std::numeric_limits<Real>::epsilon();

template <class Model, int D>
Matrix<double, D> stress_by_differences(const Model& model, const Matrix<double, D>& F, double h) {
  using Point = typename Case<Model, D, double>::Point;
  Matrix<double, D> P;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      Point plus = point_at<Case<Model, D, double>>(F), minus = plus;
      plus.F_E(i, j) += h;
      minus.F_E(i, j) -= h;
      P(i, j) = (model.energy(plus) - model.energy(minus)) / (2 * h);
    }
  return P;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("stress is the derivative of the energy", "[materials]", DoubleCases) {
  using C = TestType;
  const auto model = sample_model<typename C::Model>();
  const double scale = model.moduli.p_wave();
  Draw draw(1);
  for (const bool elastic : {true, false}) {
    double piola = 0, kirchhoff = 0;
    for (int n = 0; n < kDraws; ++n) {
      // Tait's pressure at a strain of 0.4 is thousands of moduli.
      const Matrix<double, C::D> F =
          elastic ? elastic_state<C>(draw) : near_rest<C::D>(draw, C::fluid ? 0.02 : 0.4);
      const Matrix<double, C::D> P = first_piola<typename C::Model::Energy>(F, model.moduli);
      piola = std::fmax(piola, difference(P, stress_by_differences(model, F, 1e-5), scale));
      auto p = point_at<C>(F);
      const auto response = model.update(p, 1e-3);
      if (elastic || !C::plastic)
        kirchhoff = std::fmax(kirchhoff, difference(response.tau, P * transpose(F), scale));
    }
    // Central differences with h = 1e-5 at stretches above 0.6: h^2 psi''' / 6 is about 4e-10, eps psi / h
    // 1e-11.
    CHECK(piola < 2e-9);
    CHECK(kirchhoff < kRound<double>);
  }
}

TEMPLATE_LIST_TEST_CASE("the tangent is the derivative of the stress", "[materials]", DoubleCases) {
  using C = TestType;
  using Energy = typename C::Model::Energy;
  const Lame<double> m = sample_model<typename C::Model>().moduli;
  const double h = 1e-5;
  Draw draw(2);
  double worst = 0, asymmetry = 0;
  for (int n = 0; n < kDraws; ++n) {
    const double strain = draw.of<double>({0, 1e-8, 1e-3, C::fluid ? 0.02 : 0.4});
    const Matrix<double, C::D> F = near_rest<C::D>(draw, strain);
    const Tangent<C::D> t = tangent<Energy>(F, m);
    for (int k = 0; k < C::D * C::D; ++k) {
      Matrix<double, C::D> plus = F, minus = F;
      plus(k / C::D, k % C::D) += h;
      minus(k / C::D, k % C::D) -= h;
      const Matrix<double, C::D> dP =
          (0.5 / h) * (first_piola<Energy>(plus, m) - first_piola<Energy>(minus, m));
      for (int r = 0; r < C::D * C::D; ++r) {
        worst = std::fmax(worst, std::fabs(dP(r / C::D, r % C::D) - t[r][k]) / m.p_wave());
        asymmetry = std::fmax(asymmetry, std::fabs(t[k][r] - t[r][k]) / m.p_wave());
      }
    }
  }
  // As above, one derivative higher: h^2 P''' / 6 with P''' up to 100 moduli at a stretch of 0.6.
  CHECK(worst < 1e-8);
  CHECK(asymmetry < kRound<double> * 10);
}

TEMPLATE_LIST_TEST_CASE("rest and any rotation of it are free of stress and energy", "[materials]",
                        AllCases) {
  using C = TestType;
  const auto model = sample_model<typename C::Model>();
  const double scale = model.moduli.p_wave();
  Draw draw(3);
  for (int n = 0; n < kDraws; ++n) {
    auto p = point_at<C>(n == 0 ? Matrix<double, C::D>::identity() : draw.rotation<C::D>());
    const auto response = model.update(p, typename C::Real(1e-3));
    CHECK(largest_entry(response.tau) <= kRound<typename C::Real> * scale);
    CHECK(std::fabs(model.energy(p)) <= kRound<typename C::Real> * scale);
    CHECK(response.capped == 0);
    // rho c^2 of a plane wave at rest; the neo-Hookean bound on the stretch may exceed it when rotated, by
    // sqrt(D).
    CHECK(response.wave_modulus >= (1 - kRound<typename C::Real>)*scale);
    if (n == 0) CHECK(response.wave_modulus <= (1 + kRound<typename C::Real>)*scale);
  }
}

TEMPLATE_LIST_TEST_CASE("rotating the deformed body rotates the stress, rotating it at rest changes nothing",
                        "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  // Hardening multiplies an error in F_E by moduli and xi: at 3 % strain less than 20 moduli.
  const double scale = 20 * model.moduli.p_wave();
  Draw draw(4);
  double objectivity = 0, isotropy = 0, energy = 0, symmetry = 0;
  for (int n = 0; n < kDraws; ++n) {
    const Matrix<double, C::D> F = near_rest<C::D>(draw, 0.03), Q = draw.rotation<C::D>();
    auto p = point_at<C>(F), left = point_at<C>(Q * F), right = point_at<C>(F * Q);
    const Matrix<Real, C::D> q = cast<Real>(Q);
    const auto tau = model.update(p, Real(1e-3)).tau;
    objectivity =
        std::fmax(objectivity, difference(model.update(left, Real(1e-3)).tau, q * tau * transpose(q), scale));
    isotropy = std::fmax(isotropy, difference(model.update(right, Real(1e-3)).tau, tau, scale));
    symmetry = std::fmax(symmetry, difference(tau, transpose(tau), scale));
    energy = std::fmax(energy, std::fabs(model.energy(left) - model.energy(p)) / scale);
    energy = std::fmax(energy, std::fabs(model.energy(right) - model.energy(p)) / scale);
  }
  CHECK(objectivity < kRound<Real>);
  CHECK(isotropy < kRound<Real>);
  CHECK(symmetry < kRound<Real>);
  CHECK(energy < kRound<Real>);
}

TEMPLATE_LIST_TEST_CASE("float and double give the same stress", "[materials]", FloatCases) {
  using C = TestType;
  using Reference = Case<typename C::Model, C::D, double>;
  const auto model = sample_model<typename C::Model>();
  Draw draw(5);
  for (int n = 0; n < kDraws; ++n) {
    const Matrix<double, C::D> F = near_rest<C::D>(draw, 0.03);
    auto p = point_at<C>(F);
    auto reference = point_at<Reference>(F);
    const auto tau = model.update(p, 1e-3f).tau;
    const auto expected = cast<float>(model.update(reference, 1e-3).tau);
    CHECK(difference(tau, expected, 20 * model.moduli.p_wave()) < kRound<float>);
  }
}

TEMPLATE_LIST_TEST_CASE("no wave of the energy's tangent is faster than the wave modulus says", "[materials]",
                        DoubleCases) {
  using C = TestType;
  using Energy = typename C::Model::Energy;
  const Lame<double> m = sample_model<typename C::Model>().moduli;
  Draw draw(6);
  for (int n = 0; n < kDraws; ++n) {
    // Waves along the principal axes: the longitudinal moduli s_k^2 H_kk and the shear moduli s_j^2 (minus +
    // plus)/2.
    const double range = draw.of<double>({0.01, 0.3, 2});
    const Matrix<double, C::D> F = draw.with_singular_values<C::D>(
        values_of<C::D>([&](int) { return std::exp(draw.uniform(-range, range)); }));
    const Svd<double, C::D> f = svd(F);
    const PrincipalDerivatives<C::D> d = Energy::derivatives(f.s, m);
    ElasticPoint<double, C::D> p{F};
    // Tait's J^-6 carries the round-off of J six times.
    const double round = (C::fluid ? 6 : 1) * kRound<double>;
    const double modulus = Elastic<Energy>{1000, m}.update(p, 0.0).wave_modulus * (1 + round);
    CHECK(modulus >= m.mu);
    for (int i = 0; i < C::D; ++i)
      for (int j = 0; j < C::D; ++j) {
        const double stiffness = i == j ? d.H(i, i) : 0.5 * (d.minus(i, j) + d.plus(i, j));
        CHECK(modulus >= f.s[j] * f.s[j] * stiffness);
      }
  }
}
