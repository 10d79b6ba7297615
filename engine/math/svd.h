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

namespace svd_detail {

// One Jacobi rotation of the symmetric matrix with diagonal entries pp, qq and off-diagonal pq (to be
// removed), rp, rq; the eigenvectors go along. The angle is rough, the rotation exactly normalised: what is
// left of pq is removed by the next sweep, and V stays orthogonal.
template <class L>
inline void rotate_symmetric(L& pp, L& qq, L& pq, L& rp, L& rq, Vector<L, 3>& vp, Vector<L, 3>& vq) {
  const L d = pp - qq, o = pq + pq;
  const L r2 = d * d + (o * o + L(sizeof(LaneReal<L>) == 4 ? 1e-34 : 1e-290));
  const L x = r2 * rough_inverse_sqrt(r2) + abs(d);
  const L y = flip_sign(o, d);
  const L g = inverse_sqrt(x * x + y * y);
  const L c = x * g, s = y * g;
  const L a = c * pp + s * pq, b = c * pq + s * qq, e = c * pq - s * pp, f = c * qq - s * pq;
  pp = c * a + s * b;
  pq = c * b - s * a;
  qq = c * f - s * e;
  const L r = c * rp + s * rq;
  rq = c * rq - s * rp;
  rp = r;
  for (int i = 0; i < 3; ++i) {
    const L v = c * vp[i] + s * vq[i];
    vq[i] = c * vq[i] - s * vp[i];
    vp[i] = v;
  }
}

template <class L>
struct Gram {  // F^T F and its eigenvectors, rotated towards a diagonal
  L s00, s11, s22, s01, s12, s02;
  Vector<L, 3> v[3];

  explicit Gram(const Matrix<L, 3>& F) {
    const Vector<L, 3> a = F.column(0), b = F.column(1), c = F.column(2);
    s00 = dot(a, a), s11 = dot(b, b), s22 = dot(c, c), s01 = dot(a, b), s12 = dot(b, c), s02 = dot(a, c);
    v[0] = {L(1), L(0), L(0)}, v[1] = {L(0), L(1), L(0)}, v[2] = {L(0), L(0), L(1)};
  }
  void sweep() {
    rotate_symmetric(s00, s11, s01, s02, s12, v[0], v[1]);
    rotate_symmetric(s11, s22, s12, s01, s02, v[1], v[2]);
    rotate_symmetric(s22, s00, s02, s12, s01, v[2], v[0]);
  }
  // Columns of F V that are orthogonal to round-off of their lengths.
  LaneMask<L> diagonal() const {
    const L tolerance = L(sizeof(LaneReal<L>) == 4 ? 1.6e-13 : 4e-30);
    return (s01 * s01 <= tolerance * (s00 * s11)) & (s12 * s12 <= tolerance * (s11 * s22)) &
           (s02 * s02 <= tolerance * (s00 * s22));
  }
};

}  // namespace svd_detail

/// The same with the singular values in any order, which isotropic functions do not care about: less than
/// half the work of `svd` where F is near a rotation, as most elastic states are. By Jacobi on F^T F, which
/// is accurate while the singular values are of one magnitude; the rest (inverted, flat or strongly
/// stretched, not finite) is left to `svd`. An inverted F has its negative value last.
template <class L, int D>
Svd<L, D> svd_any_order(const Matrix<L, D>& F) {
  if constexpr (D < 3) {
    return svd(F);
  } else {
    using namespace svd_detail;
    Gram<L> gram(F);
    for (int sweep = 0; sweep < 3; ++sweep) gram.sweep();
    for (int more = 0; more < 2 && any(!gram.diagonal()); ++more) {
      const LaneMask<L> done = gram.diagonal();
      const Gram<L> before = gram;
      gram.sweep();
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) gram.v[k][i] = select(done, before.v[k][i], gram.v[k][i]);
      for (L Gram<L>::*s :
           {&Gram<L>::s00, &Gram<L>::s11, &Gram<L>::s22, &Gram<L>::s01, &Gram<L>::s12, &Gram<L>::s02})
        gram.*s = select(done, before.*s, gram.*s);
    }
    Svd<L, 3> out;
    Vector<L, 3> length2;
    for (int k = 0; k < 3; ++k) {
      const Vector<L, 3>& v = gram.v[k];
      // One Newton step takes out the last bits by which the rotations are not normalised.
      const Vector<L, 3> unit = (L(1.5) - L(0.5) * dot(v, v)) * v;
      const Vector<L, 3> b = F * unit;
      length2[k] = dot(b, b);
      const L inverse = inverse_sqrt(length2[k]);
      out.s[k] = length2[k] * inverse;
      out.V.set_column(k, unit);
      out.U.set_column(k, inverse * b);
    }
    const L longest = max(max(length2[0], length2[1]), length2[2]);
    // s_mid s_min > s_max^2 / 8: below it the squares in F^T F cost digits.
    const LaneMask<L> ordinary =
        (L(64) * length2[0] * length2[1] * length2[2] > longest * longest * longest) & (longest > L(1e-6)) &
        gram.diagonal() & (determinant(out.U) > L(0));
    if (any(!ordinary)) {
      const Svd<L, 3> rest = svd(F);
      out.U = chosen(ordinary, out.U, rest.U);
      out.V = chosen(ordinary, out.V, rest.V);
      for (int k = 0; k < 3; ++k) out.s[k] = select(ordinary, out.s[k], rest.s[k]);
    }
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
