// The polar decomposition F = R U of matrices near a rotation, without a decomposition: most elastic states
// are, and this takes a fifth of the work of an SVD. 3x3, every lane type, no branches.
//
// E = F^T F - I is small. U^-1 = (I + E)^(-1/2) begins as its series up to E^2 and is refined by Newton's
// iteration X <- X (3 I - (I + E) X^2) / 2, which doubles the digits (Higham 2008, sec. 6.7): from 8e-5 where
// |E| is 1/16 to 1e-8, and to 2e-16 with a second one. All its terms are polynomials in E, so they commute
// and stay symmetric.
#pragma once

#include "engine/math/matrix.h"

namespace firn {

template <class L>
struct Symmetric3 {
  L xx, yy, zz, xy, yz, xz;

  /// Of two that commute, whose product is symmetric again.
  friend Symmetric3 operator*(const Symmetric3& a, const Symmetric3& b) {
    return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
            a.xz * b.xz + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
            a.xy * b.xz + a.yy * b.yz + a.yz * b.zz, a.xx * b.xz + a.xy * b.yz + a.xz * b.zz};
  }
  /// a I + b this
  Symmetric3 affine(L a, L b) const { return {a + b * xx, a + b * yy, a + b * zz, b * xy, b * yz, b * xz}; }
};

template <class L>
struct NearRotation {
  Symmetric3<L> E;                 // F^T F - I
  L J;                             // det F
  L least_square, largest_square;  // no singular value's square is less or more

  explicit NearRotation(const Matrix<L, 3>& F) : J(determinant(F)) {
    const Vector<L, 3> a = F.column(0), b = F.column(1), c = F.column(2);
    E = {dot(a, a) - L(1), dot(b, b) - L(1), dot(c, c) - L(1), dot(a, b), dot(b, c), dot(a, c)};
    // The eigenvalues of E lie this far around their mean at most: one does when the others are equal.
    const L mean = L(1.0 / 3) * (E.xx + E.yy + E.zz);
    const L x = E.xx - mean, y = E.yy - mean, z = E.zz - mean;
    const L shear = E.xy * E.xy + E.yz * E.yz + E.xz * E.xz;
    const L spread = sqrt(L(2.0 / 3) * (x * x + y * y + z * z + L(2) * shear));
    least_square = L(1) + (mean - spread);
    largest_square = L(1) + (mean + spread);
  }

  /// Where rotation() has the precision of L.
  LaneMask<L> valid() const {
    constexpr double kNear = 1.0 / 16;
    return (least_square >= L(1 - kNear)) & (largest_square <= L(1 + kNear)) & (J > L(0));
  }

  /// R, with the F this was made of.
  Matrix<L, 3> rotation(const Matrix<L, 3>& F) const {
    const Symmetric3<L> S = E.affine(L(1), L(1));
    Symmetric3<L> X = (E.affine(L(-0.5), L(0.375)) * E).affine(L(1), L(1));
    for (int n = 0; n < (sizeof(LaneReal<L>) == 4 ? 1 : 2); ++n)
      X = X * (S * (X * X)).affine(L(1.5), L(-0.5));
    return F * Matrix<L, 3>{{{X.xx, X.xy, X.xz}, {X.xy, X.yy, X.yz}, {X.xz, X.yz, X.zz}}};
  }
};

}  // namespace firn
