// The operations a material may use on numbers, so that it is written once: a lane is a float or double here
// and 16 floats (8 doubles) at a time in the vectorised path. No branches on data: comparisons give masks,
// masks select.
//
// A lane type L supports + - * / and unary -, == < <= > >= giving LaneMask<L>, construction from double, and
// the functions below found by unqualified name. Masks support & | !.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace firn {

template <class L>
struct LaneTraits {
  using Real = L;
  using Mask = bool;
};
template <class L>
using LaneReal = typename LaneTraits<L>::Real;
template <class L>
using LaneMask = typename LaneTraits<L>::Mask;

/// `a` where the mask holds, else `b`. Both are evaluated.
template <class T>
requires std::is_floating_point_v<T>
constexpr T select(bool mask, T a, T b) {
  return mask ? a : b;
}

inline float sqrt(float x) {
  return std::sqrt(x);
}
inline double sqrt(double x) {
  return std::sqrt(x);
}
inline float exp(float x) {
  return std::exp(x);
}
inline double exp(double x) {
  return std::exp(x);
}
inline float log(float x) {
  return std::log(x);
}
inline double log(double x) {
  return std::log(x);
}
inline float abs(float x) {
  return std::fabs(x);
}
inline double abs(double x) {
  return std::fabs(x);
}
/// |magnitude| with the sign of `sign` (that of -0 included).
inline float copysign(float magnitude, float sign) {
  return std::copysign(magnitude, sign);
}
inline double copysign(double magnitude, double sign) {
  return std::copysign(magnitude, sign);
}
/// The smaller and the larger; with a NaN among them, `b`.
constexpr float min(float a, float b) {
  return a < b ? a : b;
}
constexpr double min(double a, double b) {
  return a < b ? a : b;
}
constexpr float max(float a, float b) {
  return a > b ? a : b;
}
constexpr double max(double a, double b) {
  return a > b ? a : b;
}

template <class L>
L clamp(L x, L low, L high) {
  return min(max(x, low), high);
}

}  // namespace firn
