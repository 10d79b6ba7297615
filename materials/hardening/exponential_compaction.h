// Snow's hardening (Stomakhin et al. 2013, eq. 2): the moduli grow with plastic compaction and fade with
// plastic expansion, mu = mu0 exp(xi (1 - J_P)), lam alike. J_P = det F_P; xi dimensionless.
//
// The published factor has no bound: at xi = 10 it is 20 at J_P = 0.7 and 8100 at 0.1, and the time step
// shrinks with its root. So it stops at `cap`, and the points at the cap are counted. A factor beyond the
// square root of what the number type holds (1e19 in float) stops there too, cap or not: a product with the
// moduli must stay finite.
#pragma once

#include <cmath>

#include "materials/principal.h"

namespace firn {

struct ExponentialCompaction {
  static constexpr std::string_view name = "exponential in J_P";

  double xi;       // -
  double log_cap;  // ln of the largest factor; infinity: none

  template <class L>
  struct Result {
    L factor, capped;
  };
  template <class L>
  Result<L> evaluate(L J_P) const {
    const double log_range = 0.5 * std::log(static_cast<double>(std::numeric_limits<LaneReal<L>>::max()));
    const L most = L(std::fmin(log_cap, log_range));
    const L exponent = L(xi) * (L(1) - J_P);
    return {exp(min(exponent, most)), select(exponent > most, L(1), L(0))};
  }
};

}  // namespace firn
