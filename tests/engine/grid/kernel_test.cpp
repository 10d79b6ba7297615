#include "engine/grid/kernel.h"

#include <limits>

#include <catch2/catch.hpp>

using namespace firn;

namespace {

/// The weights at a place x, in cells, of the nodes from `first` on.
template <class Kernel, class Real>
struct At {
  Real first, f, w[Kernel::nodes], dw[Kernel::nodes];

  At(Real x, Real size) : first(Kernel::first_node(x, size)), f(x - first) {
    Kernel::weights(f, size, w, dw);
  }
  Real weight(double node) const {
    const double n = node - static_cast<double>(first);
    return n < 0 || n >= Kernel::nodes ? Real(0) : w[static_cast<int>(n)];
  }
};

const double kSizes[] = {0.5, 0.25, 0.2, 0.125, 1e-3};

}  // namespace

TEMPLATE_TEST_CASE("weights reproduce constants and linear functions, everywhere", "",
                   (std::pair<LinearKernel, float>), (std::pair<LinearKernel, double>),
                   (std::pair<GimpKernel, float>), (std::pair<GimpKernel, double>),
                   (std::pair<QuadraticKernel, float>), (std::pair<QuadraticKernel, double>),
                   (std::pair<CubicKernel, float>), (std::pair<CubicKernel, double>)) {
  using Kernel = typename TestType::first_type;
  using Real = typename TestType::second_type;
  const Real eps = std::numeric_limits<Real>::epsilon();
  for (const double size : kSizes) {
    if (!Kernel::sized && size != kSizes[0]) continue;
    // GIMP divides by the size, and so multiplies the rounding of f by 1/L.
    const Real scale = Kernel::sized ? Real(2 / size) : Real(1);
    for (int k = -1500; k <= 1500; ++k) {
      const Real x = Real(k) / 500 + Real(1e-4);
      const At<Kernel, Real> at(x, Real(size));
      Real sum = 0, moment = 0, inertia = 0, dsum = 0, dmoment = 0;
      for (int n = 0; n < Kernel::nodes; ++n) {
        const Real r = Real(n) - at.f;
        sum += at.w[n];
        moment += at.w[n] * r;
        inertia += at.w[n] * r * r;
        dsum += at.dw[n];
        dmoment += at.dw[n] * r;
        REQUIRE(at.w[n] >= 0);
      }
      // A handful of operations on numbers of size one.
      REQUIRE(std::abs(sum - 1) < 4 * eps * scale);
      REQUIRE(std::abs(moment) < 8 * eps * scale);
      REQUIRE(std::abs(dsum) < 4 * eps * scale);
      REQUIRE(std::abs(dmoment - 1) < 8 * eps * scale);
      if constexpr (Kernel::affine) REQUIRE(std::abs(inertia * Real(Kernel::inverse_inertia) - 1) < 16 * eps);
    }
  }
}

TEMPLATE_TEST_CASE("derivatives are the derivatives of the weights", "", LinearKernel, GimpKernel,
                   QuadraticKernel, CubicKernel) {
  const double e = 1e-6;
  for (const double size : {0.5, 0.25, 0.125})
    for (double x = -2.0003; x < 2; x += 0.0173) {
      const At<TestType, double> at(x, size), low(x - e, size), high(x + e, size);
      // Where a piece of the kernel ends between low and high, its second derivative jumps by up to 1/L = 8:
      // the difference is then off by up to 8 e; elsewhere by cancellation, eps / e, and e^2 of the cubic.
      for (int n = 0; n < TestType::nodes; ++n) {
        const double node = at.first + n;
        REQUIRE(at.dw[n] == Approx((high.weight(node) - low.weight(node)) / (2 * e)).margin(1e-5));
      }
    }
}

TEMPLATE_TEST_CASE("weights are continuous where the first node changes", "", LinearKernel, GimpKernel,
                   QuadraticKernel, CubicKernel) {
  const double e = 1e-9;
  for (const double size : {0.5, 0.25, 0.125})
    for (double x = -2; x <= 2; x += 0.125) {
      const At<TestType, double> below(x - e, size), above(x + e, size);
      for (double node = -5; node <= 5; ++node)
        REQUIRE(below.weight(node) == Approx(above.weight(node)).margin(4 * e));
    }
}

TEST_CASE("values of the kernels at places that can be checked by hand") {
  const At<LinearKernel, double> linear(0.25, 0);
  CHECK(linear.weight(0) == Approx(0.75));
  CHECK(linear.weight(1) == Approx(0.25));
  // L = 1/4. On a node: 1 - L/2 and L/4 on both sides. At 0.9, u = -0.1 of node 1: 1 - (0.01 + 0.0625)/0.5.
  const At<GimpKernel, double> on_node(2, 0.25), near_node(0.9, 0.25);
  CHECK(on_node.weight(2) == Approx(0.875));
  CHECK(on_node.weight(1) == Approx(0.0625));
  CHECK(on_node.weight(3) == Approx(0.0625));
  CHECK(near_node.weight(1) == Approx(0.855));
  CHECK(near_node.weight(0) == Approx(0.35 * 0.35));
  CHECK(near_node.weight(2) == Approx(0.15 * 0.15));
  const At<QuadraticKernel, double> quadratic(3, 0);
  CHECK(quadratic.weight(3) == Approx(0.75));
  CHECK(quadratic.weight(4) == Approx(0.125));
  const At<CubicKernel, double> cubic(-1, 0);
  CHECK(cubic.weight(-1) == Approx(2.0 / 3));
  CHECK(cubic.weight(-2) == Approx(1.0 / 6));
}

TEST_CASE("GIMP becomes the linear kernel as its particles shrink") {
  for (double x = 0.0137; x < 3; x += 0.0871) {
    const At<GimpKernel, double> gimp(x, 1e-6);
    const At<LinearKernel, double> linear(x, 0);
    // They differ by (L - |u|)^2 / (4 L) within L of a node, and not at all elsewhere.
    for (double node = 0; node <= 4; ++node)
      CHECK(gimp.weight(node) == Approx(linear.weight(node)).margin(1e-6));
  }
}

TEST_CASE(
    "GIMP's weights are the mean of the linear ones over the particle, its slopes that of their slopes") {
  constexpr int kPieces = 2000;
  for (const double size : {0.5, 0.25, 0.1})
    for (double x = 0.0137; x < 2; x += 0.0871) {
      const At<GimpKernel, double> gimp(x, size);
      for (double node = -1; node <= 4; ++node) {
        double mean = 0;
        for (int k = 0; k < kPieces; ++k) {
          const At<LinearKernel, double> piece(x + size * ((2 * k + 1.0) / kPieces - 1), 0);
          mean += piece.weight(node) / kPieces;
        }
        // The midpoint rule is exact but for the two or three pieces with a kink: (2 L / n)^2.
        CHECK(gimp.weight(node) == Approx(mean).margin(1e-6));
        const At<LinearKernel, double> low(x - size, 0), high(x + size, 0);
        const double n = node - gimp.first;
        const double slope = n < 0 || n > 2 ? 0 : gimp.dw[static_cast<int>(n)];
        CHECK(slope == Approx((high.weight(node) - low.weight(node)) / (2 * size)).margin(1e-12));
      }
    }
}

TEMPLATE_TEST_CASE("a particle's nodes lie in its block's scratch as far as it may drift", "", LinearKernel,
                   GimpKernel, QuadraticKernel, CubicKernel) {
  for (const double size : {0.5, 0.25, 1e-3})
    for (double at_sort = -4; at_sort < 4; at_sort += 0.01) {
      const double cell = std::floor(at_sort - TestType::sort_offset);
      const double block = 4 * std::floor(cell / 4);  // its first node
      for (const double drift : {-TestType::farthest_drift, TestType::farthest_drift}) {
        const double first = TestType::first_node(at_sort + drift, size);
        CHECK(first >= block - 1);
        CHECK(first + TestType::nodes - 1 < block + 7);
      }
    }
}
