#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>
#include <tbb/parallel_for.h>

#include "engine/base/vector_formula.h"

namespace firn {
namespace {

constexpr std::array<std::string_view, 2> kNames = {"x", "t"};

double value(const std::string& text, double x = 0, double t = 0) {
  return Formula(text, kNames)(std::array{x, t});
}

TEST_CASE("a formula has the value that its text says") {
  CHECK(value("0.1 * sin(pi * x / 2)", 1) == Approx(0.1).epsilon(1e-15));
  CHECK(value("-x^2 + 3*t", 2, 5) == 11);
  CHECK(value("x < 1 ? t : -t", 0.5, 7) == 7);
  CHECK(value("x >= 1 && t == 7 ? 1 : 2", 1, 7) == 1);
  CHECK(value("ln(exp(x))", 1.25) == Approx(1.25).epsilon(1e-15));
  CHECK(value("min(x, t, 3) + max(1, 2)", 4, 5) == 5);
  CHECK(std::isnan(value("sqrt(x)", -1)));
}

TEST_CASE("what is no formula says why") {
  for (const char* wrong :
       {"", "1 +", "sin(", "q + 1", "2 x", "1, 2", "x = 3", "x == ", "a(1)", "\"x\"", "1..2"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(value(wrong), FormulaError);
  }
  CHECK_THROWS_WITH(value("q + 1"), Catch::Contains("q"));
  CHECK_THROWS_WITH(value("x = 3"), Catch::Contains("=="));
  CHECK_THROWS_AS(value(std::string(5000, '(')), FormulaError);
  CHECK_THROWS_AS(value(std::string(4000, '(')), FormulaError);
}

TEST_CASE("copies of a formula do not share their numbers") {
  const Formula formula("x + t", kNames);
  tbb::parallel_for(0, 100, [&](int k) {
    const Formula mine = formula;
    for (int i = 0; i < 100; ++i)
      if (mine(std::array{double(k), double(i)}) != k + i) FAIL_CHECK("another thread's numbers");
  });
}

TEST_CASE("a vector of numbers and formulas") {
  const VectorFormula v({{{1, {}}, {0, "x * t"}, {}}}, kNames);
  CHECK(v(std::array{2.0, 3.0}) == std::array{1.0, 6.0, 0.0});
  CHECK_FALSE(v.constant());
  CHECK(VectorFormula({{{1, {}}, {2, {}}, {}}}, kNames).constant());
}

}  // namespace
}  // namespace firn
