// The two moduli of an isotropic solid. mu, lam: Lame's, Pa. From Young's modulus E and Poisson's ratio nu by
// the three-dimensional relations, in every dimension: a 2D or 1D model is a d x d model of its own, not
// plane strain (plane strain is d = 3 with F33 = 1).
#pragma once

#include "engine/math/lane.h"

namespace firn {

template <class L>
struct Lame {
  L mu, lam;

  template <class M>
  constexpr Lame<M> as() const {
    return {M(mu), M(lam)};
  }
  /// lambda + 2 mu: what resists a plane compression wave at rest.
  constexpr L p_wave() const { return lam + L(2) * mu; }
};

template <class L>
constexpr Lame<L> operator*(L factor, const Lame<L>& m) {
  return {factor * m.mu, factor * m.lam};
}

/// Valid for E > 0 and nu in (-1, 0.5).
constexpr Lame<double> lame(double youngs_modulus, double poissons_ratio) {
  return {youngs_modulus / (2 * (1 + poissons_ratio)),
          youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio))};
}

}  // namespace firn
