// The first Piola-Kirchhoff stress P = dpsi/dF and its derivative dP/dF of an isotropic energy, from its
// derivatives in the singular values. Cold code: the material-point driver and tests; the step uses the
// Kirchhoff stress only.
#pragma once

#include <array>

#include "engine/math/svd.h"
#include "materials/principal.h"

namespace firn {

/// tangent[i * D + j][k * D + l] = dP_ij / dF_kl.
template <int D>
using Tangent = std::array<std::array<double, D * D>, D * D>;

template <class Energy, int D>
Matrix<double, D> first_piola(const Matrix<double, D>& F, const Lame<double>& m) {
  const Svd<double, D> f = svd(F);
  return compose(f.U, Energy::derivatives(f.s, m).p, f.V);
}

/// With M = U^T dF V: (U^T dP V)_ii = sum_j H_ij M_jj, and for i != j
/// (U^T dP V)_ij = (minus + plus)/2 M_ij + (minus - plus)/2 M_ji.
template <int D>
Matrix<double, D> principal_increment(const PrincipalDerivatives<D>& d, const Matrix<double, D>& M) {
  Matrix<double, D> out = Matrix<double, D>::zero();
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      out(i, i) += d.H(i, j) * M(j, j);
      if (i == j) continue;
      out(i, j) =
          0.5 * (d.minus(i, j) + d.plus(i, j)) * M(i, j) + 0.5 * (d.minus(i, j) - d.plus(i, j)) * M(j, i);
    }
  return out;
}

template <class Energy, int D>
Tangent<D> tangent(const Matrix<double, D>& F, const Lame<double>& m) {
  const Svd<double, D> f = svd(F);
  const PrincipalDerivatives<D> d = Energy::derivatives(f.s, m);
  Tangent<D> out;
  for (int k = 0; k < D; ++k)
    for (int l = 0; l < D; ++l) {
      // dF = e_k e_l^T, so M_ij = U_ki V_lj.
      Matrix<double, D> M;
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) M(i, j) = f.U(k, i) * f.V(l, j);
      const Matrix<double, D> dP = f.U * principal_increment(d, M) * transpose(f.V);
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) out[i * D + j][k * D + l] = dP(i, j);
    }
  return out;
}

}  // namespace firn
