// The operations a material may use on numbers, so that it is written once: a lane is a float or double here
// and 16 floats (8 doubles) at a time in the vectorised path. No branches on data: comparisons give masks,
// masks select.
//
// A lane type L supports + - * / and unary -, == < <= > >= giving LaneMask<L>, construction from double, and
// the functions below found by unqualified name. Masks support & | !, and `any` for work that is seldom
// needed: a result must not depend on whether a neighbour needed it.
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
inline float sin(float x) {
  return std::sin(x);
}
inline double sin(double x) {
  return std::sin(x);
}
inline float abs(float x) {
  return std::fabs(x);
}
inline double abs(double x) {
  return std::fabs(x);
}
/// 1/sqrt(x) of a positive normal number, to a few units in the last place; and to 11 bits or better.
template <class T>
requires std::is_floating_point_v<T> T inverse_sqrt(T x) {
  return T(1) / std::sqrt(x);
}
template <class T>
requires std::is_floating_point_v<T> T rough_inverse_sqrt(T x) {
  return T(1) / std::sqrt(x);
}
/// x, or -x where `sign` is negative (-0 included).
template <class T>
requires std::is_floating_point_v<T> T flip_sign(T x, T sign) {
  return std::signbit(sign) ? -x : x;
}
inline bool any(bool mask) {
  return mask;
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
