// Two numbers side by side, as a vectorised lane is: a comparison gives a mask that is no bool, so code that
// branches on data does not compile. Counts the square roots.
#pragma once

#include "engine/math/lane.h"

namespace firn::test {

struct PairMask {
  bool a, b;
  friend PairMask operator&(PairMask x, PairMask y) { return {x.a && y.a, x.b && y.b}; }
  friend PairMask operator|(PairMask x, PairMask y) { return {x.a || y.a, x.b || y.b}; }
  friend PairMask operator!(PairMask x) { return {!x.a, !x.b}; }
  friend bool any(PairMask x) { return x.a || x.b; }
};

struct PairLane {
  double a, b;
  static inline long roots = 0;

  PairLane() = default;
  constexpr explicit PairLane(double x) : a(x), b(x) {}
  constexpr PairLane(double x, double y) : a(x), b(y) {}

  friend constexpr PairLane operator+(PairLane x, PairLane y) { return {x.a + y.a, x.b + y.b}; }
  friend constexpr PairLane operator-(PairLane x, PairLane y) { return {x.a - y.a, x.b - y.b}; }
  friend constexpr PairLane operator*(PairLane x, PairLane y) { return {x.a * y.a, x.b * y.b}; }
  friend constexpr PairLane operator/(PairLane x, PairLane y) { return {x.a / y.a, x.b / y.b}; }
  friend constexpr PairLane operator-(PairLane x) { return {-x.a, -x.b}; }
  friend PairMask operator==(PairLane x, PairLane y) { return {x.a == y.a, x.b == y.b}; }
  friend PairMask operator<(PairLane x, PairLane y) { return {x.a < y.a, x.b < y.b}; }
  friend PairMask operator<=(PairLane x, PairLane y) { return {x.a <= y.a, x.b <= y.b}; }
  friend PairMask operator>(PairLane x, PairLane y) { return {x.a > y.a, x.b > y.b}; }
  friend PairMask operator>=(PairLane x, PairLane y) { return {x.a >= y.a, x.b >= y.b}; }

  friend PairLane select(PairMask m, PairLane x, PairLane y) { return {m.a ? x.a : y.a, m.b ? x.b : y.b}; }
  friend PairLane sqrt(PairLane x) {
    ++roots;
    return {firn::sqrt(x.a), firn::sqrt(x.b)};
  }
  friend PairLane exp(PairLane x) { return {firn::exp(x.a), firn::exp(x.b)}; }
  friend PairLane log(PairLane x) { return {firn::log(x.a), firn::log(x.b)}; }
  friend PairLane abs(PairLane x) { return {firn::abs(x.a), firn::abs(x.b)}; }
  friend PairLane copysign(PairLane x, PairLane y) {
    return {firn::copysign(x.a, y.a), firn::copysign(x.b, y.b)};
  }
  friend PairLane inverse_sqrt(PairLane x) {
    ++roots;
    return {firn::inverse_sqrt(x.a), firn::inverse_sqrt(x.b)};
  }
  friend PairLane rough_inverse_sqrt(PairLane x) { return inverse_sqrt(x); }
  friend PairLane flip_sign(PairLane x, PairLane y) {
    return {firn::flip_sign(x.a, y.a), firn::flip_sign(x.b, y.b)};
  }
  friend PairLane min(PairLane x, PairLane y) { return {firn::min(x.a, y.a), firn::min(x.b, y.b)}; }
  friend PairLane max(PairLane x, PairLane y) { return {firn::max(x.a, y.a), firn::max(x.b, y.b)}; }
};

}  // namespace firn::test

template <>
struct firn::LaneTraits<firn::test::PairLane> {
  using Real = double;
  using Mask = firn::test::PairMask;
};
