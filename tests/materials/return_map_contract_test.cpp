// What every model promises about its return map; for an elastic one that it changes nothing.
#include <catch2/catch.hpp>

#include "tests/materials/model_cases.h"

using namespace firn;
using namespace firn::test;

namespace {

template <class Real>
constexpr double kRound = 60 * std::numeric_limits<Real>::epsilon();

// F; of a fluid, which forgets its shape, a matrix of the same volume.
template <class C>
Matrix<typename C::Real, C::D> total(const typename C::Point& p) {
  if constexpr (C::fluid) {
    auto out = Matrix<typename C::Real, C::D>::identity();
    out(0, 0) = determinant(p.F_E);
    return out;
  } else if constexpr (C::plastic) {
    return p.F_E * p.F_P;
  } else {
    return p.F_E;
  }
}

// How far the singular values of F_E lie outside of what the model allows with this history.
template <class Model, class Real, int D>
double outside(const Model& model, const Matrix<Real, D>& F_E, [[maybe_unused]] auto history) {
  const Vector<Real, D> s = svd(F_E).s;
  if constexpr (requires { model.yield; }) {
    return static_cast<double>(norm(model.yield.project(s) - s));
  } else if constexpr (requires { model.flow; }) {
    const Lame<Real> m = model.moduli.template as<Real>();
    return static_cast<double>(norm(model.flow.project(s, m, history, Real(1e-3)) - s));
  } else {
    return 0;
  }
}
template <class Point>
auto history_of(const Point& p) {
  if constexpr (requires { p.history; }) {
    return p.history;
  } else {
    return NoHistory<float>{};
  }
}

template <class Real, int D>
bool finite(const Response<Real, D>& r) {
  return std::isfinite(largest_entry(r.tau)) && std::isfinite(r.wave_modulus) && r.wave_modulus > 0 &&
         std::isfinite(r.dissipated) && (r.capped == 0 || r.capped == 1);
}

// Singular values that break things, the last one of either sign.
template <class C>
Matrix<double, C::D> nasty(Draw& draw) {
  const std::vector<double> values = {0, 1e-12, 1e-6, 1e-3, 0.5, 1, 1 + 1e-13, 1e3, 1e6};
  Vector<double, C::D> s = values_of<C::D>([&](int) { return draw.of(values); });
  // J^2 times a modulus must fit: in float the volume may grow by 1e12 at most.
  if (sizeof(typename C::Real) == 4 && product(s) > 1e12) s[0] = 1;
  if (draw.uniform(0, 1) < 0.5) s[C::D - 1] = -s[C::D - 1];
  return draw.with_singular_values<C::D>(s);
}

}  // namespace

// A rate leaves a point outside and lets it go on (see models of their own); the others are where they stay.
// The friction of sand and the size of Cam-clay's ellipse are those at the start of the step: so is the
// history here.
TEMPLATE_LIST_TEST_CASE("the return map lands inside the yield set, and repeated changes nothing",
                        "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  if constexpr (C::viscous) return;
  const auto model = sample_model<typename C::Model>();
  Draw draw(21);
  for (int n = 0; n < 300; ++n) {
    auto p =
        point_at<C>(near_rest<C::D>(draw, draw.of<double>({1e-3, 0.02, 0.5})), near_rest<C::D>(draw, 0.05));
    const auto history = history_of(p);
    const auto first = model.update(p, Real(1e-3));
    if constexpr (C::lagged) p.history = history;
    CHECK(outside(model, p.F_E, history_of(p)) < kRound<Real>);
    const auto before = p;
    const auto again = model.update(p, Real(1e-3));
    CHECK(largest_entry(p.F_E - before.F_E) < kRound<Real>);
    // The stress of the crushed state, hardened at most by the cap.
    CHECK(difference(again.tau, first.tau, 300 * model.moduli.p_wave()) < kRound<Real>);
    if constexpr (C::plastic) CHECK(largest_entry(p.F_P - before.F_P) < kRound<Real>);
  }
}

TEMPLATE_LIST_TEST_CASE("an elastic step changes no bit of the deformation and dissipates nothing",
                        "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  Draw draw(22);
  for (int n = 0; n < 300; ++n) {
    auto p = point_at<C>(elastic_state<C>(draw), near_rest<C::D>(draw, 0.05));
    const auto before = p;
    const auto response = model.update(p, Real(1e-3));
    if constexpr (!C::fluid) CHECK(largest_entry(p.F_E - before.F_E) == 0);
    if constexpr (C::plastic) CHECK(largest_entry(p.F_P - before.F_P) == 0);
    CHECK(response.dissipated == 0);
  }
}

TEMPLATE_LIST_TEST_CASE("the return map leaves F_E F_P as it was", "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  Draw draw(23);
  for (int n = 0; n < 300; ++n) {
    auto p = point_at<C>(near_rest<C::D>(draw, draw.of<double>({0.02, 0.5})), near_rest<C::D>(draw, 0.3));
    const Matrix<Real, C::D> F = total<C>(p);
    model.update(p, Real(1e-3));
    CHECK(largest_entry(total<C>(p) - F) < kRound<Real>);
  }
}

TEMPLATE_LIST_TEST_CASE("F_E F_P stays F over ten thousand small steps", "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  Draw draw(24);
  auto p = point_at<C>(Matrix<double, C::D>::identity());
  Matrix<double, C::D> F = Matrix<double, C::D>::identity();
  const int steps = 10000;
  for (int n = 0; n < steps; ++n) {
    const Matrix<double, C::D> step = Matrix<double, C::D>::identity() + 2e-3 * draw.matrix<C::D>();
    F = step * F;
    p.F_E = cast<Real>(step) * p.F_E;
    model.update(p, Real(1e-3));
  }
  // Each step rounds a few times, at random: 2 eps sqrt(steps), times F's condition, which a random walk of
  // 0.2 makes about 2. A rebuilt F_E drifts by eps * steps.
  if (C::fluid) {
    const double J = determinant(F);
    F = Matrix<double, C::D>::identity();
    F(0, 0) = J;
  }
  const double bound =
      10 * std::numeric_limits<Real>::epsilon() * std::sqrt(double(steps)) * std::fmax(1, largest_entry(F));
  CHECK(difference(total<C>(p), cast<Real>(F), 1) < bound);
}

TEMPLATE_LIST_TEST_CASE("plastic work is not negative", "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  Draw draw(25);
  auto p = point_at<C>(Matrix<double, C::D>::identity());
  double dissipated = 0;
  for (int n = 0; n < 5000; ++n) {
    const Matrix<double, C::D> step = Matrix<double, C::D>::identity() + 2e-3 * draw.matrix<C::D>();
    p.F_E = cast<Real>(step) * p.F_E;
    const double stored = static_cast<double>(model.energy(p));
    const double work = static_cast<double>(model.update(p, Real(1e-3)).dissipated);
    // The stored energy itself is a difference of numbers of size modulus x strain: its round-off.
    const double round = kRound<Real> * 20 * model.moduli.p_wave() * 0.05;
    CHECK(work >= -round);
    CHECK(std::fabs(stored - static_cast<double>(model.energy(p)) - work) <= round);
    dissipated += work;
  }
  // In one dimension there is no shear, and what keeps the volume never flows.
  CHECK((dissipated > 0) == (C::plastic && !(C::D == 1 && C::isochoric)));
}

// Half of them nasty, half of them ordinary; each number type takes its half of a million.
TEMPLATE_LIST_TEST_CASE("no deformation, however broken, gives a NaN or an endless wave speed", "[materials]",
                        AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  Draw draw(26);
  const int states = C::D == 1 ? 3000 : 500'000;
  int infinite = 0, outsiders = 0, inverted = 0;
  for (int n = 0; n < states; ++n) {
    const Matrix<double, C::D> F = n == 0       ? Matrix<double, C::D>::zero()
                                   : n % 2 == 0 ? nasty<C>(draw)
                                                : near_rest<C::D>(draw, draw.of<double>({1e-9, 0.01, 0.9}));
    auto p = point_at<C>(F, near_rest<C::D>(draw, 0.1));
    const auto history = history_of(p);
    const auto response = model.update(p, Real(1e-3));
    const bool sound =
        finite(response) && std::isfinite(largest_entry(total<C>(p))) && std::isfinite(model.energy(p));
    if (!sound && infinite++ == 0) UNSCOPED_INFO("s " << svd(F).s[0] << " .. " << svd(F).s[C::D - 1]);
    const double s0 = std::fmax(1, std::fabs(svd(F).s[0]));
    // F_E is corrected by (s* - s), so it is inside to the round-off of the largest s.
    if constexpr (requires { model.yield; })
      outsiders += outside(model, p.F_E, history) < kRound<Real> * s0 ? 0 : 1;
    if (C::plastic && s0 * std::numeric_limits<Real>::epsilon() < 1e-3)
      inverted += determinant(p.F_E) > 0 ? 0 : 1;
  }
  CHECK(infinite == 0);
  CHECK(outsiders == 0);
  CHECK(inverted == 0);
}

TEMPLATE_LIST_TEST_CASE("a deformation that is no number is not mended", "[materials]", AllCases) {
  using C = TestType;
  using Real = typename C::Real;
  const auto model = sample_model<typename C::Model>();
  for (int i = 0; i < C::D; ++i)
    for (int j = 0; j < C::D; ++j) {
      auto p = point_at<C>(Matrix<double, C::D>::identity());
      p.F_E(i, j) = std::numeric_limits<Real>::quiet_NaN();
      const auto response = model.update(p, Real(1e-3));
      CHECK_FALSE(std::isfinite(frobenius2(response.tau) + response.wave_modulus));
    }
}
