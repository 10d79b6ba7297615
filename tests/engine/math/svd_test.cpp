#include "engine/math/svd.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "tests/engine/math/svd_errors.h"

using namespace firn;
using namespace firn::test;

namespace {

constexpr int kDraws = 4000;

template <class T, int D>
bool ordered(const Vector<T, D>& s) {
  for (int k = 0; k + 1 < D; ++k)
    if (!(s[k] >= std::fabs(s[k + 1]))) return false;
  return true;
}

template <class T, int D>
void check_class(const MatrixClass<D>& c) {
  Draw draw(7);
  SvdErrors errors;
  bool in_order = true;
  for (int n = 0; n < kDraws; ++n) {
    const Matrix<T, D> F = cast<T>(c.draw(draw));
    const Svd<T, D> f = svd(F);
    errors.add(F, f);
    in_order = in_order && ordered(f.s);
  }
  INFO(c.name << " D=" << D << " bytes=" << sizeof(T));
  CHECK(errors.reconstruction < kSvdTolerance<T>);
  CHECK(errors.frames < kSvdTolerance<T>);
  CHECK(errors.determinants < kSvdTolerance<T>);
  CHECK(in_order);
}

template <int D>
double error_against_eigen(const MatrixClass<D>& c) {
  Draw draw(8);
  double worst = 0;
  for (int n = 0; n < kDraws / 4; ++n) {
    const Matrix<double, D> F = c.draw(draw);
    Eigen::Matrix<double, D, D> e;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) e(i, j) = F(i, j);
    const Eigen::Matrix<double, D, 1> expected = e.jacobiSvd().singularValues();
    const Vector<double, D> s = svd(F).s;
    const double scale = std::fmax(expected[0], std::numeric_limits<double>::min());
    for (int k = 0; k < D; ++k) worst = std::fmax(worst, std::fabs(std::fabs(s[k]) - expected[k]) / scale);
  }
  return worst;
}

template <class T>
void check_never_nan() {
  Draw draw(9);
  const std::vector<double> entries = {0,
                                       -0.0,
                                       1,
                                       -1,
                                       std::numeric_limits<T>::denorm_min(),
                                       std::numeric_limits<T>::min(),
                                       -std::numeric_limits<T>::max(),
                                       std::numeric_limits<T>::max(),
                                       1e-30,
                                       1e-20,
                                       1e18,
                                       1e30};
  for (int n = 0; n < 200000; ++n) {
    Matrix<T, 3> F;
    for (auto& row : F.m)
      for (T& x : row) x = static_cast<T>(draw.of(entries));
    const Svd<T, 3> f = svd(F);
    const bool sound =
        frame_error(f.U) < kSvdTolerance<T> && frame_error(f.V) < kSvdTolerance<T> && ordered(f.s);
    if (!sound) FAIL("entries " << F(0, 0) << " " << F(0, 1) << " " << F(0, 2) << " .. " << F(2, 2));
  }
}

}  // namespace

TEST_CASE("SVD in 3D rebuilds every kind of matrix from rotations and ordered values", "[svd]") {
  for (const auto& c : matrix_classes<3>()) {
    check_class<double>(c);
    check_class<float>(c);
  }
}

TEST_CASE("SVD in 2D rebuilds every kind of matrix from rotations and ordered values", "[svd]") {
  for (const auto& c : matrix_classes<2>()) {
    check_class<double>(c);
    check_class<float>(c);
  }
}

TEST_CASE("SVD in 1D is the number itself", "[svd]") {
  for (const auto& c : matrix_classes<1>()) {
    check_class<double>(c);
    check_class<float>(c);
  }
  CHECK(svd(Matrix<double, 1>{{{-0.25}}}).s[0] == -0.25);
}

TEST_CASE("SVD's values are those of an independent implementation", "[svd]") {
  // Both err by a few units in the last place of the largest value.
  for (const auto& c : matrix_classes<3>()) {
    INFO(c.name);
    CHECK(error_against_eigen(c) < 1e-14);
  }
  for (const auto& c : matrix_classes<2>()) {
    INFO(c.name);
    CHECK(error_against_eigen(c) < 1e-14);
  }
}

TEST_CASE("SVD puts the sign of the determinant on the last value", "[svd]") {
  Draw draw(10);
  for (int n = 0; n < kDraws; ++n) {
    const Matrix<double, 3> F3 = draw.matrix<3>();
    const Matrix<double, 2> F2 = draw.matrix<2>();
    CHECK((svd(F3).s[2] < 0) == (determinant(F3) < 0));
    CHECK((svd(F2).s[1] < 0) == (determinant(F2) < 0));
  }
}

TEST_CASE("SVD of entries between denormal and the largest number gives no NaN", "[svd]") {
  check_never_nan<double>();
  check_never_nan<float>();
}

TEST_CASE("SVD of the zero matrix is the identity's frames and zeros", "[svd]") {
  const Svd<float, 3> f = svd(Matrix<float, 3>::zero());
  CHECK(largest_entry(f.U - Matrix<float, 3>::identity()) == 0);
  CHECK(largest_entry(f.V - Matrix<float, 3>::identity()) == 0);
  CHECK(norm(f.s) == 0);
}
