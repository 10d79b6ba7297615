// How fast a yielding point may flow: the stress that a yield stress `sigma` (Pa) and a rate of plastic
// strain (1/s) carry together. Rate-independent is the limit in which the rate costs nothing.
#pragma once

#include <string_view>

#include "engine/math/lane.h"

namespace firn {

/// A stress (Pa), and its derivatives in sigma (-) and in the rate (Pa s).
template <class L>
struct RatedStress {
  L value, by_sigma, by_rate;
};

struct RateIndependent {
  static constexpr std::string_view name = "none";
  static constexpr bool linear = true;

  template <class L>
  RatedStress<L> stress(const L& sigma, const L&) const {
    return {sigma, L(1), L(0)};
  }
};

/// Perzyna 1966 with a linear overstress: stress = sigma + eta rate.
struct PerzynaRate {
  static constexpr std::string_view name = "Perzyna";
  static constexpr bool linear = true;
  double eta;  // Pa s, > 0

  template <class L>
  RatedStress<L> stress(const L& sigma, const L& rate) const {
    return {sigma + L(eta) * rate, L(1), L(eta)};
  }
};

/// Johnson & Cook 1983 without temperature: stress = sigma (1 + C ln(rate / rate_0)) above rate_0, sigma
/// below.
struct JohnsonCookRate {
  static constexpr std::string_view name = "Johnson-Cook";
  static constexpr bool linear = false;
  double C, rate_0;  // -, 1/s

  template <class L>
  RatedStress<L> stress(const L& sigma, const L& rate) const {
    const L factor = L(1) + L(C) * log(max(rate * L(1 / rate_0), L(1)));
    return {sigma * factor, factor, select(rate > L(rate_0), L(C) * sigma / max(rate, L(rate_0)), L(0))};
  }
};

}  // namespace firn
