#include "engine/grid/kernel.h"

#include <cmath>

#include <catch2/catch.hpp>

using firn::QuadraticKernel;

TEMPLATE_TEST_CASE("quadratic weights reproduce constants and linear functions", "", float, double) {
  const TestType eps = std::numeric_limits<TestType>::epsilon();
  for (int k = 0; k <= 1000; ++k) {
    const TestType f = TestType(0.5) + TestType(k) / 1000;
    TestType w[3], dw[3];
    QuadraticKernel::weights(f, w, dw);
    TestType sum = 0, moment = 0, inertia = 0, dsum = 0, dmoment = 0;
    for (int n = 0; n < 3; ++n) {
      const TestType r = TestType(n) - f;
      sum += w[n];
      moment += w[n] * r;
      inertia += w[n] * r * r;
      dsum += dw[n];
      dmoment += dw[n] * r;
      REQUIRE(w[n] >= 0);
    }
    // A handful of operations on numbers of size one.
    REQUIRE(std::abs(sum - 1) < 4 * eps);
    REQUIRE(std::abs(moment) < 4 * eps);
    REQUIRE(std::abs(inertia * TestType(QuadraticKernel::inverse_inertia) - 1) < 16 * eps);
    REQUIRE(std::abs(dsum) < 4 * eps);
    REQUIRE(std::abs(dmoment - 1) < 8 * eps);
  }
}

TEST_CASE("quadratic derivatives are the derivatives of the weights") {
  const double e = 1e-5;
  for (double f = 0.5 + 2 * e; f < 1.5 - e; f += 0.0173) {
    double w[3], dw[3], low[3], high[3], unused[3];
    QuadraticKernel::weights(f, w, dw);
    QuadraticKernel::weights(f - e, low, unused);
    QuadraticKernel::weights(f + e, high, unused);
    // Central differences of a quadratic are exact; what is left is cancellation, eps / e.
    for (int n = 0; n < 3; ++n) REQUIRE(dw[n] == Approx((high[n] - low[n]) / (2 * e)).margin(1e-10));
  }
}

TEST_CASE("quadratic weights are continuous where the first node changes") {
  double at_end[3], at_start[3], unused[3];
  QuadraticKernel::weights(1.5, at_end, unused);
  QuadraticKernel::weights(0.5, at_start, unused);
  CHECK(at_end[0] == 0.0);
  CHECK(at_start[2] == 0.0);
  CHECK(at_end[1] == at_start[0]);
  CHECK(at_end[2] == at_start[1]);
}
