#include "engine/math/near_rotation.h"

#include <catch2/catch.hpp>

#include "tests/engine/math/matrix_classes.h"

using namespace firn;
using namespace firn::test;

TEMPLATE_TEST_CASE("the rotation of what is near one has the precision of its type", "[near_rotation]", float,
                   double) {
  using T = TestType;
  // F = R U is known from how it is made. Ten roundings of numbers near 1; the float's F adds one of its own.
  const double tolerance = 10 * static_cast<double>(std::numeric_limits<T>::epsilon());
  Draw draw(41);
  double worst = 0;
  int valid = 0;
  for (int n = 0; n < 20000; ++n) {
    const double strain = draw.of<double>({0, 1e-8, 1e-3, 0.01, 0.03});
    const Matrix<double, 3> R = draw.rotation<3>(), V = draw.rotation<3>();
    const auto s = values_of<3>([&](int) { return 1 + draw.uniform(-strain, strain); });
    const Matrix<T, 3> F = cast<T>(R * V * Matrix<double, 3>::diagonal(s) * transpose(V));
    const NearRotation<T> near(F);
    if (!near.valid()) continue;
    ++valid;
    worst = std::fmax(worst, largest_entry(near.rotation(F) - cast<T>(R)));
  }
  CHECK(valid > 15000);
  CHECK(worst < tolerance);
}

TEST_CASE("the bounds hold all singular values, and are reached", "[near_rotation]") {
  Draw draw(42);
  double tightest = 1;
  for (int n = 0; n < 20000; ++n) {
    const double strain = draw.of<double>({1e-6, 0.01, 0.3, 2});
    Vector<double, 3> s = values_of<3>([&](int) { return 1 + draw.uniform(-strain, strain); });
    if (n % 3 == 0) s[1] = s[0];  // two alike: one of the bounds is exact
    const NearRotation<double> near(draw.with_singular_values<3>(s));
    double least = s[0] * s[0], largest = least;
    for (int k = 1; k < 3; ++k) {
      least = std::fmin(least, s[k] * s[k]);
      largest = std::fmax(largest, s[k] * s[k]);
    }
    // A dozen roundings of squares.
    const double rounding = 1e-14 * std::fmax(1, largest);
    REQUIRE(near.least_square <= least + rounding);
    REQUIRE(near.largest_square >= largest - rounding);
    tightest = std::fmin(tightest, std::fmin(least - near.least_square, near.largest_square - largest) /
                                       std::fmax(largest - least, 1e-9));
  }
  CHECK(tightest < 1e-6);
}

TEST_CASE("what is far from a rotation, inverted or not finite is not valid", "[near_rotation]") {
  const auto valid = [](const Vector<double, 3>& s) {
    return NearRotation<double>(Matrix<double, 3>::diagonal(s)).valid();
  };
  CHECK(valid({1, 1, 1}));
  CHECK(valid({1.025, 1, 1}));
  CHECK(valid({0.975, 0.975, 0.975}));
  CHECK_FALSE(valid({1.04, 1, 1}));
  CHECK_FALSE(valid({1, 0.96, 1}));
  CHECK_FALSE(valid({1, 1, -1}));
  CHECK_FALSE(valid({1, 1, std::numeric_limits<double>::quiet_NaN()}));
  CHECK_FALSE(valid({std::numeric_limits<double>::infinity(), 1, 1}));
}
