// What a large step costs in the stress. Laws that are given as rates need their steps divided (Buzzi,
// Pedroso & Giacomini 2008, section 4.2, after Sloan 1987); here the elastic stress is a function of F, and
// only what flows depends on the path.
#include <catch2/catch.hpp>

#include "materials/registry.h"
#include "tests/materials/model_cases.h"

namespace firn {
namespace {

using Matrix3 = Matrix<double, 3>;

/// F changes by I + e D per unit of the path.
Matrix3 rate() {
  Matrix3 D = Matrix3::zero();
  D(0, 0) = -0.05;
  D(1, 1) = 0.02;
  D(0, 1) = 0.04;
  return D;
}

template <class Model>
Matrix3 stress_after(const Model& model, int steps) {
  typename Model::template Point<double, 3> point;
  point.visit([](auto, auto& F) { F = Matrix3::identity(); });
  const Matrix3 step = Matrix3::identity() + (1.0 / steps) * rate();
  Matrix3 tau = Matrix3::zero();
  for (int k = 0; k < steps; ++k) {
    point.F_E = step * point.F_E;
    tau = model.update(point, 1.0 / steps).tau;
  }
  return tau;
}

double distance(const Matrix3& a, const Matrix3& b) {
  return std::sqrt(frobenius2(a - b) / frobenius2(b));
}

TEST_CASE("elastic stress does not depend on how a step is divided, but for F itself") {
  const auto model = std::get<NeoHookean>(
      make_material("neo_hookean", {{"density", 1}, {"youngs_modulus", 10}, {"poissons_ratio", 0.3}}));
  // The same F at once.
  Matrix3 F = Matrix3::identity();
  for (int k = 0; k < 16; ++k) F = (Matrix3::identity() + (1.0 / 16) * rate()) * F;
  NeoHookean::Point<double, 3> point;
  point.F_E = F;
  CHECK(distance(stress_after(model, 16), model.update(point, 1.0).tau) < 1e-14);
}

TEST_CASE("plastic stress converges with the number of substeps, and one step is not far off") {
  const auto model =
      std::get<SnowStomakhin2013>(make_material("snow_stomakhin_2013", {{"density", 400},
                                                                        {"youngs_modulus", 1.4e5},
                                                                        {"poissons_ratio", 0.2},
                                                                        {"theta_c", 2.5e-2},
                                                                        {"theta_s", 7.5e-3},
                                                                        {"xi", 10},
                                                                        {"hardening_cap", 300}}));
  const Matrix3 fine = stress_after(model, 4096);
  const double one = distance(stress_after(model, 1), fine), four = distance(stress_after(model, 4), fine),
               sixteen = distance(stress_after(model, 16), fine);
  CAPTURE(one, four, sixteen);
  // A return map is implicit in the step's end: first order.
  CHECK(four / sixteen == Approx(4).epsilon(0.25));
  CHECK(one < 0.1);
}

}  // namespace
}  // namespace firn
