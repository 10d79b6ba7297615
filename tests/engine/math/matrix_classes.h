// Matrices of the kinds that break decompositions, drawn at random.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "engine/math/matrix.h"

namespace firn::test {

class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  double normal() { return std::normal_distribution<double>()(generator_); }
  template <class T>
  const T& of(const std::vector<T>& values) {
    return values[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(generator_)];
  }

  template <int D>
  Matrix<double, D> matrix() {
    Matrix<double, D> out;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) out(i, j) = normal();
    return out;
  }

  /// A rotation from Gram-Schmidt on random columns: it does not rest on the decompositions under test.
  template <int D>
  Matrix<double, D> rotation() {
    Matrix<double, D> q = matrix<D>();
    for (int j = 0; j < D; ++j) {
      Vector<double, D> c = q.column(j);
      for (int pass = 0; pass < 2; ++pass)
        for (int k = 0; k < j; ++k) c = c - dot(q.column(k), c) * q.column(k);
      q.set_column(j, (1 / norm(c)) * c);
    }
    if (determinant(q) < 0) q.set_column(D - 1, -1.0 * q.column(D - 1));
    return q;
  }

  template <int D>
  Matrix<double, D> with_singular_values(const Vector<double, D>& s) {
    return rotation<D>() * Matrix<double, D>::diagonal(s) * rotation<D>();
  }

 private:
  std::mt19937 generator_;
};

template <int D>
struct MatrixClass {
  std::string name;
  std::function<Matrix<double, D>(Draw&)> draw;
};

/// s_k for k = 0, 1, .. from a function of k.
template <int D, class F>
Vector<double, D> values_of(F f) {
  Vector<double, D> out;
  for (int k = 0; k < D; ++k) out[k] = f(k);
  return out;
}

template <int D>
std::vector<MatrixClass<D>> matrix_classes() {
  const auto from = [](auto f) {
    return [f](Draw& r) { return r.with_singular_values<D>(values_of<D>([&](int k) { return f(r, k); })); };
  };
  const auto last = [](int k) { return k == D - 1; };
  return {
      {"random", [](Draw& r) { return r.matrix<D>(); }},
      {"identity", [](Draw&) { return Matrix<double, D>::identity(); }},
      {"zero", [](Draw&) { return Matrix<double, D>::zero(); }},
      {"rotation", [](Draw& r) { return r.rotation<D>(); }},
      {"reflection", from([=](Draw&, int k) { return last(k) ? -1.0 : 1.0; })},
      {"inverted", from([=](Draw& r, int k) { return (last(k) ? -1 : 1) * r.uniform(0.1, 2); })},
      {"repeated", from([=](Draw& r, int k) { return last(k) ? r.uniform(-1, 1) : 1.0; })},
      {"near-repeated 1e-13", from([](Draw& r, int) { return 1 + 1e-13 * r.uniform(-1, 1); })},
      {"small repeated", from([](Draw&, int k) { return k == 0 ? 1 : 1e-3; })},
      {"rank one less", from([=](Draw& r, int k) { return last(k) ? 0 : r.uniform(0.1, 2); })},
      {"rank 1", from([](Draw& r, int k) { return k == 0 ? r.uniform(0.1, 2) : 0; })},
      {"flat", from([=](Draw& r, int k) { return (last(k) ? 1e-5 : 1) * r.uniform(0.5, 1.5); })},
      {"stretched", from([](Draw& r, int k) { return (k == 0 ? 20 : 1) * r.uniform(0.5, 1.5); })},
      // s_mid s_min = s_max^2 / 8, where svd_any_order goes from one way to the other.
      {"stretched by root 8", from([](Draw& r, int k) { return k == 0 ? 2.83 * r.uniform(0.99, 1.01) : 1; })},
      {"graded", from([](Draw& r, int k) { return std::pow(10, -8 * k * r.uniform(0, 1)); })},
      {"1e6 to 1e-6", from([](Draw&, int k) { return std::pow(10, 6 - 6 * k); })},
      {"scaled 1e6", [](Draw& r) { return 1e6 * r.matrix<D>(); }},
      {"scaled 1e-6", [](Draw& r) { return 1e-6 * r.matrix<D>(); }},
      {"scaled 1e38", [](Draw& r) { return 1e38 * r.rotation<D>(); }},
      {"scaled 1e-37", [](Draw& r) { return 1e-37 * r.rotation<D>(); }},
      {"any scale", [](Draw& r) { return std::pow(10, r.uniform(-12, 12)) * r.matrix<D>(); }},
      {"near rest", [](Draw& r) { return Matrix<double, D>::identity() + 1e-2 * r.matrix<D>(); }},
      {"hardly deformed", [](Draw& r) { return Matrix<double, D>::identity() + 1e-7 * r.matrix<D>(); }},
      {"small integers",
       [](Draw& r) {
         Matrix<double, D> m;
         for (auto& row : m.m)
           for (double& x : row) x = std::round(r.uniform(-1.5, 1.5));
         return m;
       }},
  };
}

template <class T, int D>
Matrix<T, D> cast(const Matrix<double, D>& a) {
  Matrix<T, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = static_cast<T>(a(i, j));
  return out;
}

template <class T, int D>
double largest_entry(const Matrix<T, D>& a) {
  double out = 0;
  for (const auto& row : a.m)
    for (T x : row) {
      if (std::isnan(x)) return std::numeric_limits<double>::infinity();
      out = std::fmax(out, std::fabs(static_cast<double>(x)));
    }
  return out;
}

}  // namespace firn::test
