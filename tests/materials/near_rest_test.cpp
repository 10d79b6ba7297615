// The short way of a point near rest answers as the general one.
#include <catch2/catch.hpp>

#include "tests/materials/model_cases.h"

using namespace firn;
using namespace firn::test;

namespace {

template <class C>
Response<typename C::Real, 3> general(const typename C::Model& model, typename C::Point& p) {
  if constexpr (C::plastic)
    return model.project(p);
  else
    return model.general_update(p);
}

template <class C>
void check_both_ways() {
  const auto model = sample_model<typename C::Model>();
  using Real = typename C::Real;
  // Stresses are differences of numbers near 1, beside the moduli: some ten roundings.
  const double tolerance = 20 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  Draw draw(51);
  int elastic = 0;
  for (int n = 0; n < 5000; ++n) {
    const double strain = draw.of<double>({0, 1e-6, 1e-3, 5e-3, 0.02, 0.03, 0.1});
    const auto F_P = near_rest<3>(draw, 0.1);
    auto p = point_at<C>(near_rest<3>(draw, strain), F_P), q = p;
    const auto before = p;
    const auto a = model.update(p, Real(0)), b = general<C>(model, q);
    const double modulus = static_cast<double>(model.current_moduli(p).p_wave());
    REQUIRE(difference(a.tau, b.tau, modulus) < tolerance);
    REQUIRE(difference(p.F_E, q.F_E, 1) < tolerance);
    // The time step may be shorter than need be, never longer; by the bound on the stretches, 1/16.
    REQUIRE(a.wave_modulus >= b.wave_modulus * Real(1 - tolerance));
    REQUIRE(a.wave_modulus <= b.wave_modulus * Real(1.07));
    REQUIRE(a.capped == b.capped);
    if (largest_entry(p.F_E - before.F_E) == 0) ++elastic;
  }
  CHECK(elastic > 1000);
}

}  // namespace

TEST_CASE("near rest, the stress without a decomposition is the stress with one", "[materials]") {
  check_both_ways<Case<FixedCorotated, 3, float>>();
  check_both_ways<Case<FixedCorotated, 3, double>>();
  check_both_ways<Case<SnowStomakhin2013, 3, float>>();
  check_both_ways<Case<SnowStomakhin2013, 3, double>>();
}
