// Polar decomposition F = R S with R a rotation (det +1, also for an inverted F) and S symmetric. S has the
// signed singular values of F: it is positive definite exactly when det F > 0.
#pragma once

#include "engine/math/svd.h"

namespace firn {

template <class L, int D>
struct Polar {
  Matrix<L, D> R, S;
};

template <class L, int D>
Polar<L, D> polar(const Matrix<L, D>& F) {
  const Svd<L, D> f = svd(F);
  return {f.U * transpose(f.V), compose(f.V, f.s, f.V)};
}

}  // namespace firn
