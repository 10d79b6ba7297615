// Snow's yield set (Stomakhin et al. 2013): the elastic stretches stay in [1 - theta_c, 1 + theta_s]. What
// lies outside becomes plastic: critical compression and critical stretch, both dimensionless.
//
// A box in the singular values, projected onto by clamping each of them: not an associated flow rule, and no
// bound on a stress. An inverted trial state (last singular value negative) is clamped to the compressed
// corner, so det F_E > 0 afterwards, and det F_P takes the sign.
#pragma once

#include "materials/principal.h"

namespace firn {

struct SingularValueClamp {
  static constexpr std::string_view name = "singular value clamp";

  double critical_compression;  // theta_c, in (0, 1)
  double critical_stretch;      // theta_s, >= 0

  /// Any energy in the singular values has a stress everywhere in the box.
  template <class Energy>
  static constexpr bool valid_with = PrincipalEnergy<Energy>;

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s) const {
    Vector<L, D> out;
    // In this order a NaN stays one.
    for (int k = 0; k < D; ++k) out[k] = min(L(1 + critical_stretch), max(L(1 - critical_compression), s[k]));
    return out;
  }

  /// Whether singular values with squares in [least, largest] are all in the set.
  template <class L>
  LaneMask<L> holds_squares(const L& least, const L& largest) const {
    const double low = 1 - critical_compression, high = 1 + critical_stretch;
    return (least >= L(low * low)) & (largest <= L(high * high));
  }

  /// Which side each singular value left the set on, for readers: L(ower), M(iddle: elastic) or U(pper).
  template <int D>
  std::string branch(const Vector<double, D>& s) const {
    const Vector<double, D> projected = project(s);
    std::string out;
    for (int k = 0; k < D; ++k) out += s[k] < projected[k] ? 'L' : s[k] > projected[k] ? 'U' : 'M';
    return out;
  }
};

}  // namespace firn
