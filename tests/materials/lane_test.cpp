// Materials are written once for numbers and for lanes of numbers.
#include <catch2/catch.hpp>

#include "tests/engine/math/pair_lane.h"
#include "tests/materials/model_cases.h"

using namespace firn;
using namespace firn::test;

namespace {

template <int D>
Matrix<PairLane, D> pair(const Matrix<double, D>& a, const Matrix<double, D>& b) {
  Matrix<PairLane, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = {a(i, j), b(i, j)};
  return out;
}

template <int D>
bool same(const Matrix<PairLane, D>& m, const Matrix<double, D>& a, const Matrix<double, D>& b) {
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j)
      if (m(i, j).a != a(i, j) || m(i, j).b != b(i, j)) return false;
  return true;
}

bool same(const PairLane& x, double a, double b) {
  return x.a == a && x.b == b;
}

template <class Model, int D>
long roots_of_one_update() {
  auto p = sample_model<Model>().template at_rest<PairLane, D>();
  Draw draw(31);
  p.visit([&](auto column, auto& value) {
    if constexpr (info(column()).rank == Rank::matrix)
      value = pair(near_rest<D>(draw, 0.1), near_rest<D>(draw, 0.1));
  });
  PairLane::roots = 0;
  sample_model<Model>().update(p, PairLane(1e-3));
  return PairLane::roots;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a pair of points computed as one lane has the bits of two points", "[materials]",
                        DoubleCases) {
  using C = TestType;
  using Pair = typename C::Model::template Point<PairLane, C::D>;
  const auto model = sample_model<typename C::Model>();
  Draw draw(32);
  for (int n = 0; n < 200; ++n) {
    // One lane elastic, the other beyond yield, inverted or flat: each must take its own way.
    auto a = point_at<C>(near_rest<C::D>(draw, 5e-3), near_rest<C::D>(draw, 0.1));
    auto b = point_at<C>(draw.with_singular_values<C::D>(values_of<C::D>([&](int) {
      return draw.of<double>({-1, 0, 0.5, 2});
    })),
                         near_rest<C::D>(draw, 0.1));
    Pair lane = model.template at_rest<PairLane, C::D>();
    lane.F_E = pair(a.F_E, b.F_E);
    if constexpr (C::plastic) lane.F_P = pair(a.F_P, b.F_P);

    const auto response = model.update(lane, PairLane(1e-3));
    const auto response_a = model.update(a, 1e-3), response_b = model.update(b, 1e-3);
    CHECK(same(lane.F_E, a.F_E, b.F_E));
    if constexpr (C::plastic) CHECK(same(lane.F_P, a.F_P, b.F_P));
    if constexpr (C::Point::columns.has(Column::hardening))
      CHECK(same(lane.history.alpha, a.history.alpha, b.history.alpha));
    if constexpr (C::grains)
      CHECK(same(lane.history.volume_gain, a.history.volume_gain, b.history.volume_gain));
    CHECK(same(response.tau, response_a.tau, response_b.tau));
    CHECK(same(response.wave_modulus, response_a.wave_modulus, response_b.wave_modulus));
    CHECK(same(response.dissipated, response_a.dissipated, response_b.dissipated));
    CHECK(same(response.capped, response_a.capped, response_b.capped));
    CHECK(same(model.energy(lane), model.energy(a), model.energy(b)));
  }
}

TEST_CASE("neo-Hookean's update takes no root and so no decomposition", "[materials]") {
  CHECK(roots_of_one_update<NeoHookean, 1>() == 0);
  CHECK(roots_of_one_update<NeoHookean, 2>() == 0);
  CHECK(roots_of_one_update<NeoHookean, 3>() == 0);
  CHECK(NeoHookean::info().decomposition == "none");
}

TEMPLATE_LIST_TEST_CASE("one update makes one decomposition at most, and says so", "[materials]",
                        DoubleCases) {
  using C = TestType;
  const long roots = roots_of_one_update<typename C::Model, C::D>();
  PairLane::roots = 0;
  svd_any_order(pair(Matrix<double, C::D>::identity(), Matrix<double, C::D>::identity()));
  // Whether a point is near rest takes a root more; one lane is not, so both ways are gone.
  const long near_rest = kHasNearRest<typename C::Model::Energy, double, C::D> ? 1 : 0;
  if constexpr (requires { typename C::Model::Flow; }) {
    // Flows take roots of their own, but fewer than a second decomposition.
    CHECK((roots < 2 * PairLane::roots || C::D == 1));
    return;
  }
  if (C::fluid) return;  // without viscosity it needs none
  CHECK(roots == (C::Model::decomposition == "none" ? 0 : PairLane::roots + near_rest));
}
