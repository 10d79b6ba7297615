// Small fixed vectors and matrices over a lane type: the inner loop's algebra, every size unrolled by the
// compiler. Row-major: m(row, column). Cold code (transforms, key frames) uses Eigen.
#pragma once

#include "engine/math/lane.h"

namespace firn {

template <class L, int D>
struct Vector {
  L v[D];

  constexpr L& operator[](int i) { return v[i]; }
  constexpr const L& operator[](int i) const { return v[i]; }

  static constexpr Vector constant(L value) {
    Vector out;
    for (int i = 0; i < D; ++i) out.v[i] = value;
    return out;
  }
  static constexpr Vector zero() { return constant(L(0)); }
};

template <class L, int D>
constexpr Vector<L, D> operator+(const Vector<L, D>& a, const Vector<L, D>& b) {
  Vector<L, D> out;
  for (int i = 0; i < D; ++i) out[i] = a[i] + b[i];
  return out;
}
template <class L, int D>
constexpr Vector<L, D> operator-(const Vector<L, D>& a, const Vector<L, D>& b) {
  Vector<L, D> out;
  for (int i = 0; i < D; ++i) out[i] = a[i] - b[i];
  return out;
}
template <class L, int D>
constexpr Vector<L, D> operator*(L s, const Vector<L, D>& a) {
  Vector<L, D> out;
  for (int i = 0; i < D; ++i) out[i] = s * a[i];
  return out;
}
template <class L, int D>
constexpr Vector<L, D>& operator+=(Vector<L, D>& a, const Vector<L, D>& b) {
  for (int i = 0; i < D; ++i) a[i] = a[i] + b[i];
  return a;
}
template <class L, int D>
constexpr L dot(const Vector<L, D>& a, const Vector<L, D>& b) {
  L out = a[0] * b[0];
  for (int i = 1; i < D; ++i) out = out + a[i] * b[i];
  return out;
}
template <class L>
constexpr Vector<L, 3> cross(const Vector<L, 3>& a, const Vector<L, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class L, int D>
L norm(const Vector<L, D>& a) {
  return sqrt(dot(a, a));
}

template <class L, int D>
struct Matrix {
  L m[D][D];

  constexpr L& operator()(int row, int column) { return m[row][column]; }
  constexpr const L& operator()(int row, int column) const { return m[row][column]; }

  static constexpr Matrix diagonal(const Vector<L, D>& d) {
    Matrix out;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) out(i, j) = i == j ? d[i] : L(0);
    return out;
  }
  static constexpr Matrix scaled_identity(L s) { return diagonal(Vector<L, D>::constant(s)); }
  static constexpr Matrix identity() { return scaled_identity(L(1)); }
  static constexpr Matrix zero() { return scaled_identity(L(0)); }

  constexpr Vector<L, D> column(int j) const {
    Vector<L, D> out;
    for (int i = 0; i < D; ++i) out[i] = m[i][j];
    return out;
  }
  constexpr void set_column(int j, const Vector<L, D>& c) {
    for (int i = 0; i < D; ++i) m[i][j] = c[i];
  }
};

template <class L, int D>
constexpr Matrix<L, D> operator+(const Matrix<L, D>& a, const Matrix<L, D>& b) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = a(i, j) + b(i, j);
  return out;
}
template <class L, int D>
constexpr Matrix<L, D> operator-(const Matrix<L, D>& a, const Matrix<L, D>& b) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = a(i, j) - b(i, j);
  return out;
}
template <class L, int D>
constexpr Matrix<L, D> operator*(L s, const Matrix<L, D>& a) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = s * a(i, j);
  return out;
}
template <class L, int D>
constexpr Matrix<L, D> operator*(const Matrix<L, D>& a, const Matrix<L, D>& b) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) {
      L sum = a(i, 0) * b(0, j);
      for (int k = 1; k < D; ++k) sum = sum + a(i, k) * b(k, j);
      out(i, j) = sum;
    }
  return out;
}
template <class L, int D>
constexpr Vector<L, D> operator*(const Matrix<L, D>& a, const Vector<L, D>& x) {
  Vector<L, D> out;
  for (int i = 0; i < D; ++i) {
    L sum = a(i, 0) * x[0];
    for (int k = 1; k < D; ++k) sum = sum + a(i, k) * x[k];
    out[i] = sum;
  }
  return out;
}
template <class L, int D>
constexpr Matrix<L, D> transpose(const Matrix<L, D>& a) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = a(j, i);
  return out;
}
template <class L, int D>
constexpr Matrix<L, D> outer(const Vector<L, D>& a, const Vector<L, D>& b) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = a[i] * b[j];
  return out;
}
template <class L, int D>
constexpr L trace(const Matrix<L, D>& a) {
  L out = a(0, 0);
  for (int i = 1; i < D; ++i) out = out + a(i, i);
  return out;
}
/// Sum of the squares of all entries.
template <class L, int D>
constexpr L frobenius2(const Matrix<L, D>& a) {
  L out = L(0);
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out = out + a(i, j) * a(i, j);
  return out;
}

/// d(det a)/da, which is det(a) a^-T where the inverse exists.
template <class L, int D>
constexpr Matrix<L, D> cofactor(const Matrix<L, D>& a) {
  if constexpr (D == 1) {
    return {{{L(1)}}};
  } else if constexpr (D == 2) {
    return {{{a(1, 1), -a(1, 0)}, {-a(0, 1), a(0, 0)}}};
  } else {
    Matrix<L, D> out;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        out(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
      }
    return out;
  }
}
template <class L, int D>
constexpr L determinant(const Matrix<L, D>& a) {
  const Matrix<L, D> c = cofactor(a);
  L out = a(0, 0) * c(0, 0);
  for (int j = 1; j < D; ++j) out = out + a(0, j) * c(0, j);
  return out;
}
/// Infinite or NaN where the determinant is zero.
template <class L, int D>
constexpr Matrix<L, D> inverse(const Matrix<L, D>& a) {
  return (L(1) / determinant(a)) * transpose(cofactor(a));
}

/// a where the mask holds, else b.
template <class L, int D>
Matrix<L, D> chosen(const LaneMask<L>& mask, const Matrix<L, D>& a, const Matrix<L, D>& b) {
  Matrix<L, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = select(mask, a(i, j), b(i, j));
  return out;
}

}  // namespace firn
