// A number that counts the floating-point operations done with it: + - * / and each root, exponential,
// logarithm or sine are one. What only picks or moves bits (min, max, abs, signs, comparisons, selections) is
// none.
#pragma once

#include <cstdint>

#include "engine/math/lane.h"

namespace firn {

template <class Real>
struct CountingLane {
  Real x;
  static inline thread_local std::int64_t flops = 0;

  CountingLane() = default;
  explicit CountingLane(double value) : x(static_cast<Real>(value)) {}

  static CountingLane counted(Real value) {
    ++flops;
    return CountingLane(static_cast<double>(value));
  }

  friend CountingLane operator+(CountingLane a, CountingLane b) { return counted(a.x + b.x); }
  friend CountingLane operator-(CountingLane a, CountingLane b) { return counted(a.x - b.x); }
  friend CountingLane operator*(CountingLane a, CountingLane b) { return counted(a.x * b.x); }
  friend CountingLane operator/(CountingLane a, CountingLane b) { return counted(a.x / b.x); }
  friend CountingLane sqrt(CountingLane a) { return counted(firn::sqrt(a.x)); }
  friend CountingLane exp(CountingLane a) { return counted(firn::exp(a.x)); }
  friend CountingLane log(CountingLane a) { return counted(firn::log(a.x)); }
  friend CountingLane sin(CountingLane a) { return counted(firn::sin(a.x)); }
  friend CountingLane inverse_sqrt(CountingLane a) { return counted(firn::inverse_sqrt(a.x)); }
  friend CountingLane rough_inverse_sqrt(CountingLane a) { return counted(firn::rough_inverse_sqrt(a.x)); }

  friend CountingLane operator-(CountingLane a) { return plain(-a.x); }
  friend CountingLane abs(CountingLane a) { return plain(firn::abs(a.x)); }
  friend CountingLane copysign(CountingLane a, CountingLane b) { return plain(firn::copysign(a.x, b.x)); }
  friend CountingLane flip_sign(CountingLane a, CountingLane b) { return plain(firn::flip_sign(a.x, b.x)); }
  friend CountingLane min(CountingLane a, CountingLane b) { return plain(firn::min(a.x, b.x)); }
  friend CountingLane max(CountingLane a, CountingLane b) { return plain(firn::max(a.x, b.x)); }
  friend CountingLane select(bool mask, CountingLane a, CountingLane b) { return mask ? a : b; }

  friend bool operator==(CountingLane a, CountingLane b) { return a.x == b.x; }
  friend bool operator<(CountingLane a, CountingLane b) { return a.x < b.x; }
  friend bool operator<=(CountingLane a, CountingLane b) { return a.x <= b.x; }
  friend bool operator>(CountingLane a, CountingLane b) { return a.x > b.x; }
  friend bool operator>=(CountingLane a, CountingLane b) { return a.x >= b.x; }

 private:
  static CountingLane plain(Real value) { return CountingLane(static_cast<double>(value)); }
};

template <class R>
struct LaneTraits<CountingLane<R>> {
  using Real = R;
  using Mask = bool;
};

}  // namespace firn
