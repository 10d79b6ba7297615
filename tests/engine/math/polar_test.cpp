#include "engine/math/polar.h"

#include <catch2/catch.hpp>

#include "tests/engine/math/matrix_classes.h"

using namespace firn;
using namespace firn::test;

namespace {

// A product of the SVD's factors: its error (tests/engine/math/svd_test.cpp) once more.
template <class T>
constexpr double kTolerance = sizeof(T) == 4 ? 1e-5 : 1.6e-14;

template <class T, int D>
void check_polar() {
  for (const auto& c : matrix_classes<D>()) {
    Draw draw(11);
    double product = 0, rotation = 0, symmetry = 0;
    for (int n = 0; n < 1000; ++n) {
      const Matrix<T, D> F = cast<T>(c.draw(draw));
      const Polar<T, D> f = polar(F);
      const T inverse = largest_entry(F) > 0 ? static_cast<T>(1 / largest_entry(F)) : T(1);
      product = std::fmax(product, largest_entry(f.R * (inverse * f.S) - inverse * F));
      rotation = std::fmax(rotation, largest_entry(f.R * transpose(f.R) - Matrix<T, D>::identity()));
      rotation = std::fmax(rotation, std::fabs(static_cast<double>(determinant(f.R)) - 1));
      symmetry = std::fmax(symmetry, largest_entry(inverse * f.S - transpose(inverse * f.S)));
    }
    INFO(c.name << " D=" << D << " bytes=" << sizeof(T));
    CHECK(product < kTolerance<T>);
    CHECK(symmetry < kTolerance<T>);
    CHECK(rotation < kTolerance<T>);
  }
}

}  // namespace

TEST_CASE("polar decomposition is a rotation times a symmetric matrix", "[polar]") {
  check_polar<double, 1>();
  check_polar<float, 1>();
  check_polar<double, 2>();
  check_polar<float, 2>();
  check_polar<double, 3>();
  check_polar<float, 3>();
}

TEST_CASE("polar decomposition gives back the rotation and the stretch it was made from", "[polar]") {
  Draw draw(12);
  for (int n = 0; n < 1000; ++n) {
    const Matrix<double, 3> R = draw.rotation<3>(), Q = draw.rotation<3>();
    const Matrix<double, 3> S = Q * Matrix<double, 3>::diagonal({1.7, 1.1, 0.4}) * transpose(Q);
    const Polar<double, 3> f = polar(R * S);
    // The rotation's condition is 1 / (sum of the two smallest values) = 0.7: nothing is lost.
    CHECK(largest_entry(f.R - R) < 1e-14);
    CHECK(largest_entry(f.S - S) < 1e-14);
  }
}
