// How fast a yielding point may flow: the stress that a yield stress `sigma` (Pa) and a rate of plastic
// strain (1/s) carry together. Rate-independent is the limit in which the rate costs nothing.
#pragma once

#include <string_view>

#include "engine/math/lane.h"

namespace firn {

struct RateIndependent {
  static constexpr std::string_view name = "none";
  static constexpr bool linear = true, instant = true;

  /// What a rate of plastic strain adds to the stress: Pa s. Perzyna's eta.
  template <class L>
  L viscosity() const {
    return L(0);
  }
  template <class L>
  L factor(const L&) const {
    return L(1);
  }
  template <class L>
  L factor_slope(const L&) const {
    return L(0);
  }
};

/// Perzyna 1966 with a linear overstress: stress - sigma = eta times the rate.
struct PerzynaRate {
  static constexpr std::string_view name = "Perzyna";
  static constexpr bool linear = true, instant = false;
  double eta;  // Pa s, > 0

  template <class L>
  L viscosity() const {
    return L(eta);
  }
  template <class L>
  L factor(const L&) const {
    return L(1);
  }
  template <class L>
  L factor_slope(const L&) const {
    return L(0);
  }
};

/// Johnson & Cook 1983 without temperature: stress = sigma (1 + C ln(rate / rate_0)) above rate_0, sigma
/// below.
struct JohnsonCookRate {
  static constexpr std::string_view name = "Johnson-Cook";
  static constexpr bool linear = false, instant = false;
  double C, rate_0;  // -, 1/s

  template <class L>
  L viscosity() const {
    return L(0);
  }
  template <class L>
  L factor(const L& rate) const {
    return L(1) + L(C) * log(max(rate * L(1 / rate_0), L(1)));
  }
  template <class L>
  L factor_slope(const L& rate) const {
    return select(rate > L(rate_0), L(C) / max(rate, L(rate_0)), L(0));
  }
};

}  // namespace firn
