// The decomposition the vectorised materials use: what `svd` promises but for the order, alone and in lanes.
#include <algorithm>
#include <array>
#include <cstring>

#include <catch2/catch.hpp>

#include "tests/engine/math/pair_lane.h"
#include "tests/engine/math/svd_errors.h"

using namespace firn;
using namespace firn::test;

namespace {

constexpr int kDraws = 4000;

template <class T, int D>
Matrix<PairOf<T>, D> pair(const Matrix<T, D>& a, const Matrix<T, D>& b) {
  Matrix<PairOf<T>, D> out;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) out(i, j) = {a(i, j), b(i, j)};
  return out;
}

/// One half of a lane's answer.
template <class T, int D>
Svd<T, D> half(const Svd<PairOf<T>, D>& f, T PairOf<T>::*side) {
  Svd<T, D> out;
  for (int i = 0; i < D; ++i) {
    out.s[i] = f.s[i].*side;
    for (int j = 0; j < D; ++j) out.U(i, j) = f.U(i, j).*side, out.V(i, j) = f.V(i, j).*side;
  }
  return out;
}

template <class T, int D>
bool same_bits(const Svd<T, D>& f, const Svd<T, D>& g) {
  static_assert(sizeof f == (2 * D * D + D) * sizeof(T));
  return std::memcmp(&f, &g, sizeof f) == 0;
}

/// The largest difference of the values as sets, by the largest value.
template <class T, int D>
double value_error(Vector<T, D> a, Vector<T, D> b) {
  std::sort(a.v, a.v + D);
  std::sort(b.v, b.v + D);
  double largest = std::numeric_limits<T>::min(), difference = 0;
  for (int k = 0; k < D; ++k) {
    largest = std::fmax(largest, std::fabs(static_cast<double>(b[k])));
    difference = std::fmax(difference, std::fabs(static_cast<double>(a[k]) - static_cast<double>(b[k])));
  }
  return difference / largest;
}

/// `decompose`: F -> its factors.
template <class T, int D, class Decompose>
void check_class(const MatrixClass<D>& c, Decompose decompose) {
  Draw draw(17);
  SvdErrors errors;
  double values = 0;
  for (int n = 0; n < kDraws; ++n) {
    const Matrix<T, D> F = cast<T>(c.draw(draw));
    const Svd<T, D> f = decompose(F);
    errors.add(F, f);
    values = std::fmax(values, value_error(f.s, svd(F).s));
  }
  INFO(c.name << " D=" << D << " bytes=" << sizeof(T));
  // The same few rotations as `svd`, so the same rounding. Values: that of both.
  CHECK(errors.reconstruction < kSvdTolerance<T>);
  CHECK(errors.frames < kSvdTolerance<T>);
  CHECK(errors.determinants < kSvdTolerance<T>);
  CHECK(values < kSvdTolerance<T>);
}

template <class T, int D>
void check_classes() {
  for (const auto& c : matrix_classes<D>()) {
    check_class<T>(c, [](const Matrix<T, D>& F) { return svd_any_order(F); });
    // As a processor's estimate of a root has it: too long and too short by as much as is allowed.
    for (const T roughness : {T(1) / 2048, T(-1) / 2048}) {
      PairOf<T>::roughness = roughness;
      check_class<T>(c, [](const Matrix<T, D>& F) { return half(svd_any_order(pair(F, F)), &PairOf<T>::a); });
      PairOf<T>::roughness = 0;
    }
  }
}

template <class T, int D>
void check_neighbours() {
  const auto classes = matrix_classes<D>();
  for (const auto& one : classes)
    for (const auto& other : classes) {
      Draw draw(18);
      bool same = true;
      for (int n = 0; n < 20; ++n) {
        const Matrix<T, D> F = cast<T>(one.draw(draw)), G = cast<T>(other.draw(draw));
        const auto f = svd_any_order(pair(F, G)), g = svd_any_order(pair(G, F));
        const Svd<T, D> alone = svd_any_order(F);
        same = same && same_bits(half(f, &PairOf<T>::a), alone) && same_bits(half(g, &PairOf<T>::b), alone);
      }
      INFO(one.name << " beside " << other.name << " D=" << D << " bytes=" << sizeof(T));
      CHECK(same);
    }
}

}  // namespace

TEMPLATE_TEST_CASE("SVD in any order rebuilds every kind of matrix from rotations and the values of SVD",
                   "[svd]", float, double) {
  check_classes<TestType, 2>();
  check_classes<TestType, 3>();
}

TEMPLATE_TEST_CASE("SVD in any order of a lane does not depend on its neighbour", "[svd]", float, double) {
  check_neighbours<TestType, 2>();
  check_neighbours<TestType, 3>();
}

TEST_CASE("SVD in any order puts the sign of the determinant on the last value", "[svd]") {
  Draw draw(19);
  for (int n = 0; n < kDraws; ++n) {
    const Matrix<double, 3> F = draw.matrix<3>();
    const Vector<double, 3> s = svd_any_order(F).s;
    REQUIRE(s[0] >= 0);
    REQUIRE(s[1] >= 0);
    REQUIRE((s[2] < 0) == (determinant(F) < 0));
  }
}
