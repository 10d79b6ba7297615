// The friction angle of sand (Klar et al. 2016, eq. 30): it grows with the plastic strain q and settles,
//
//   phi(q) = h0 + (h1 q - h3) exp(-h2 q)      a = sqrt(2/3) 2 sin phi / (3 - sin phi)
//
// h0, h3 in degrees, h1 in degrees per strain, h2 per strain. a: the slope of the cone |dev tau| over
// pressure.
#pragma once

#include <numbers>
#include <string_view>

#include "engine/math/lane.h"

namespace firn {

struct FrictionAngle {
  static constexpr std::string_view name = "friction angle";

  double h0, h1, h2, h3;

  template <class L>
  L degrees(const L& q) const {
    return max(L(h0) + (L(h1) * q - L(h3)) * exp(-(L(h2) * q)), L(0));
  }
  template <class L>
  L slope(const L& q) const {
    const L sine = sin(L(std::numbers::pi / 180) * degrees(q));
    return L(std::sqrt(2.0 / 3) * 2) * sine / (L(3) - sine);
  }
};

}  // namespace firn
