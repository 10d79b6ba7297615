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

template <class Real>
struct PairOf {
  Real a, b;
  static inline long roots = 0;
  /// The relative error of rough_inverse_sqrt, which may be up to 2^-11.
  static inline Real roughness = 0;

  PairOf() = default;
  constexpr explicit PairOf(double x) : a(static_cast<Real>(x)), b(static_cast<Real>(x)) {}
  constexpr PairOf(Real x, Real y) : a(x), b(y) {}

  friend constexpr PairOf operator+(PairOf x, PairOf y) { return {x.a + y.a, x.b + y.b}; }
  friend constexpr PairOf operator-(PairOf x, PairOf y) { return {x.a - y.a, x.b - y.b}; }
  friend constexpr PairOf operator*(PairOf x, PairOf y) { return {x.a * y.a, x.b * y.b}; }
  friend constexpr PairOf operator/(PairOf x, PairOf y) { return {x.a / y.a, x.b / y.b}; }
  friend constexpr PairOf operator-(PairOf x) { return {-x.a, -x.b}; }
  friend PairMask operator==(PairOf x, PairOf y) { return {x.a == y.a, x.b == y.b}; }
  friend PairMask operator<(PairOf x, PairOf y) { return {x.a < y.a, x.b < y.b}; }
  friend PairMask operator<=(PairOf x, PairOf y) { return {x.a <= y.a, x.b <= y.b}; }
  friend PairMask operator>(PairOf x, PairOf y) { return {x.a > y.a, x.b > y.b}; }
  friend PairMask operator>=(PairOf x, PairOf y) { return {x.a >= y.a, x.b >= y.b}; }

  friend PairOf select(PairMask m, PairOf x, PairOf y) { return {m.a ? x.a : y.a, m.b ? x.b : y.b}; }
  friend PairOf sqrt(PairOf x) {
    ++roots;
    return {firn::sqrt(x.a), firn::sqrt(x.b)};
  }
  friend PairOf exp(PairOf x) { return {firn::exp(x.a), firn::exp(x.b)}; }
  friend PairOf log(PairOf x) { return {firn::log(x.a), firn::log(x.b)}; }
  friend PairOf sin(PairOf x) { return {firn::sin(x.a), firn::sin(x.b)}; }
  friend PairOf abs(PairOf x) { return {firn::abs(x.a), firn::abs(x.b)}; }
  friend PairOf copysign(PairOf x, PairOf y) { return {firn::copysign(x.a, y.a), firn::copysign(x.b, y.b)}; }
  friend PairOf inverse_sqrt(PairOf x) {
    ++roots;
    return {firn::inverse_sqrt(x.a), firn::inverse_sqrt(x.b)};
  }
  friend PairOf rough_inverse_sqrt(PairOf x) {
    return PairOf(1 + roughness, 1 + roughness) * inverse_sqrt(x);
  }
  friend PairOf flip_sign(PairOf x, PairOf y) {
    return {firn::flip_sign(x.a, y.a), firn::flip_sign(x.b, y.b)};
  }
  friend PairOf min(PairOf x, PairOf y) { return {firn::min(x.a, y.a), firn::min(x.b, y.b)}; }
  friend PairOf max(PairOf x, PairOf y) { return {firn::max(x.a, y.a), firn::max(x.b, y.b)}; }
};
using PairLane = PairOf<double>;

}  // namespace firn::test

template <class R>
struct firn::LaneTraits<firn::test::PairOf<R>> {
  using Real = R;
  using Mask = firn::test::PairMask;
};
