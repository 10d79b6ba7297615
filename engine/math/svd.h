// Signed singular value decomposition F = U diag(s) V^T of 1x1, 2x2 and 3x3 matrices, for every lane type.
//
// U and V are rotations (det +1), s0 >= s1 >= |s2|, and the sign of det F sits on the last singular value, so
// that an inverted element is the one with a negative s. One-sided Jacobi (Hestenes 1958): rotate pairs of
// columns of F until they are orthogonal, B = F V; their lengths are s, their directions U. Working on F and
// not on F^T F keeps small singular values to round-off of the largest one.
//
// No branches on data and a fixed number of sweeps. Finite input gives no NaN: the matrix is scaled by its
// largest entry first, and directions that the matrix leaves open (rank 0 or 1) are filled in. s overflows
// only if it must.
#pragma once

#include "engine/math/matrix.h"

namespace firn {

template <class L, int D>
struct Svd {
  Matrix<L, D> U;
  Vector<L, D> s;
  Matrix<L, D> V;
};

namespace svd_detail {

// Sweeps until the worst of some million matrices stands still: 3 leave 1e-5 in float and double alike, 4
// leave round-off. In 2D one rotation is exact up to round-off and the second removes that.
template <int D>
inline constexpr int kSweeps = D == 2 ? 2 : 4;

// Its square is still a normal number. Columns below the root of it (1e-9 in float, 1e-75 in double, the
// largest entry being 1) need not be made orthogonal: they are far below round-off.
template <class L>
inline L tiny() {
  return L(sizeof(LaneReal<L>) == 4 ? 1e-18 : 1e-150);
}

// Rotates columns p and q of B by at most 45 degrees so that they become orthogonal, and V along with them.
template <int p, int q, class L, int D>
inline void rotate_columns(Matrix<L, D>& B, Matrix<L, D>& V) {
  const Vector<L, D> bp = B.column(p), bq = B.column(q);
  const L d = dot(bp, bp) - dot(bq, bq);
  const L o = L(2) * dot(bp, bq);
  // tan(angle) = o / (d +- sqrt(d^2 + o^2)), normalised from both legs: d = o = 0 gives no rotation, and
  // c^2 + s^2 = 1 to round-off whatever the angle.
  const L x = sqrt(d * d + o * o + tiny<L>() * tiny<L>()) + abs(d);
  const L y = select(d < L(0), -o, o);
  const L h = L(1) / sqrt(x * x + y * y);
  const L c = x * h, s = y * h;
  for (int i = 0; i < D; ++i) {
    const L b = B(i, p), v = V(i, p);
    B(i, p) = c * b + s * B(i, q);
    B(i, q) = c * B(i, q) - s * b;
    V(i, p) = c * v + s * V(i, q);
    V(i, q) = c * V(i, q) - s * v;
  }
}

// Swaps columns p and q of B and V where q is the longer one; the change of sign keeps V a rotation.
template <int p, int q, class L, int D>
inline void order_columns(Matrix<L, D>& B, Matrix<L, D>& V, Vector<L, D>& length2) {
  const LaneMask<L> swap = length2[p] < length2[q];
  const L longer = max(length2[p], length2[q]);
  length2[q] = min(length2[p], length2[q]);
  length2[p] = longer;
  for (Matrix<L, D>* m : {&B, &V})
    for (int i = 0; i < D; ++i) {
      const L a = (*m)(i, p), b = (*m)(i, q);
      (*m)(i, p) = select(swap, b, a);
      (*m)(i, q) = select(swap, -a, b);
    }
}

template <class L, int D>
inline Vector<L, D> normalised(const Vector<L, D>& a) {
  return (L(1) / norm(a)) * a;
}

// The unit vector of b's part orthogonal to the unit vector u; any unit vector orthogonal to u where b is
// nothing or nearly parallel to u (a column that vanished).
template <class L>
inline Vector<L, 3> orthogonal_direction(const Vector<L, 3>& u, const Vector<L, 3>& b) {
  const Vector<L, 3> w = b - dot(u, b) * u;
  const L w2 = dot(w, w);
  const LaneMask<L> open = (w2 <= tiny<L>() * tiny<L>()) | (w2 <= L(0.25) * dot(b, b));
  const LaneMask<L> x_is_small = abs(u[0]) < L(0.7);
  const Vector<L, 3> any = {select(x_is_small, L(0), u[2]), select(x_is_small, u[2], L(0)),
                            select(x_is_small, -u[1], -u[0])};
  Vector<L, 3> out;
  for (int i = 0; i < 3; ++i) out[i] = select(open, any[i], w[i]);
  return normalised(out);
}

// U and s from B = U diag(s): the first column's direction, then what is orthogonal to it, the last one so
// that U is a rotation; its s takes the sign.
template <class L, int D>
inline void split_columns(const Matrix<L, D>& B, Matrix<L, D>& U, Vector<L, D>& s) {
  const Vector<L, D> b0 = B.column(0);
  s[0] = norm(b0);
  const Vector<L, D> u0 = (L(1) / s[0]) * b0;
  U.set_column(0, u0);
  if constexpr (D == 2) {
    const Vector<L, 2> u1 = {-u0[1], u0[0]};
    U.set_column(1, u1);
    s[1] = clamp(dot(u1, B.column(1)), -s[0], s[0]);
  } else {
    const Vector<L, 3> u1 = orthogonal_direction(u0, B.column(1));
    const Vector<L, 3> u2 = cross(u0, u1);
    U.set_column(1, u1);
    U.set_column(2, u2);
    s[1] = clamp(dot(u1, B.column(1)), L(0), s[0]);
    s[2] = clamp(dot(u2, B.column(2)), -s[1], s[1]);
  }
}

}  // namespace svd_detail

template <class L, int D>
Svd<L, D> svd(const Matrix<L, D>& F) {
  if constexpr (D == 1) {
    return {Matrix<L, 1>::identity(), {F(0, 0)}, Matrix<L, 1>::identity()};
  } else {
    using namespace svd_detail;
    L largest = L(0);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) largest = max(abs(F(i, j)), largest);
    // Neither the scale nor its inverse is a denormal number; entries come out in [2^-52, 4] at the extremes.
    const L smallest = L(std::numeric_limits<LaneReal<L>>::min());
    const L scale = clamp(largest, smallest, L(1) / smallest);
    const L inverse_scale = L(1) / scale;
    const LaneMask<L> nonzero = largest > L(0);

    Matrix<L, D> B = inverse_scale * F;
    for (int i = 0; i < D; ++i)
      B(i, i) = select(nonzero, B(i, i), L(1));  // zero: the identity's frames, s = 0
    Svd<L, D> out;
    out.V = Matrix<L, D>::identity();
    for (int sweep = 0; sweep < kSweeps<D>; ++sweep) {
      rotate_columns<0, 1>(B, out.V);
      if constexpr (D == 3) {
        rotate_columns<0, 2>(B, out.V);
        rotate_columns<1, 2>(B, out.V);
      }
    }

    Vector<L, D> length2;
    for (int j = 0; j < D; ++j) length2[j] = dot(B.column(j), B.column(j));
    order_columns<0, 1>(B, out.V, length2);
    if constexpr (D == 3) {
      order_columns<0, 2>(B, out.V, length2);
      order_columns<1, 2>(B, out.V, length2);
    }
    split_columns(B, out.U, out.s);
    const L back = select(nonzero, scale, L(0));
    for (int j = 0; j < D; ++j) out.s[j] = back * out.s[j];
    return out;
  }
}

/// U diag(d) V^T.
template <class L, int D>
Matrix<L, D> compose(const Matrix<L, D>& U, const Vector<L, D>& d, const Matrix<L, D>& V) {
  Matrix<L, D> scaled;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) scaled(i, j) = U(i, j) * d[j];
  return scaled * transpose(V);
}

}  // namespace firn
