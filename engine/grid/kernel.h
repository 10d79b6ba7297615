// Shape functions of the grid, one axis; D axes are their product. A kernel is a type with
//
//   nodes               per axis
//   sort_offset         a particle belongs to the cell floor(x/h - this)
//   farthest_drift      how many cells a particle may move before it is sorted again; past that its nodes
//                       would leave the scratch of its block
//   affine              whether sum S (x_i - x_p)^2 is h^2 / inverse_inertia wherever the particle is, which
//                       APIC and MLS-MPM take for granted
//   sized               whether it depends on the particle's size; elsewhere `size` is not read
//   first_node(x, size) of a particle at x/h
//   weights(f, size, w, dw)
//                       at f = x/h - first node: the nodes' weights, and their derivatives by x/h
//
// `size` is half the particle's edge, in cells. For all kernels sum S = 1 and sum S (x_i - x_p) = 0 wherever
// the particle is (Steffen, Kirby & Berzins 2008).
#pragma once

#include <cmath>

namespace firn {

/// The hat of the original method (Sulsky, Chen & Schreyer 1994): 1 - |u| with u = (x_p - x_i)/h. Its
/// gradient jumps where a particle crosses into the next cell.
struct LinearKernel {
  static constexpr int nodes = 2;
  static constexpr double sort_offset = 0, farthest_drift = 0.95;
  static constexpr bool affine = false, sized = false;

  template <class Real>
  static Real first_node(Real x, Real) {
    return std::floor(x);
  }
  /// f in [0, 1).
  template <class Real>
  static void weights(Real f, Real, Real (&w)[2], Real (&dw)[2]) {
    w[0] = Real(1) - f;
    w[1] = f;
    dw[0] = Real(-1);
    dw[1] = Real(1);
  }
};

/// The hat averaged over a particle that keeps its size (uGIMP; Bardenhagen & Kober 2004), L = size in (0,
/// 1/2]: 1 - (u^2 + L^2)/(2L) for |u| < L, 1 - |u| up to 1 - L, (1 + L - |u|)^2/(4L) up to 1 + L.
struct GimpKernel {
  static constexpr int nodes = 3;
  // The first node is that of the cell or the one before, so that sorting need not know the size.
  static constexpr double sort_offset = 0, farthest_drift = 0;
  static constexpr bool affine = false, sized = true;

  template <class Real>
  static Real first_node(Real x, Real size) {
    return std::floor(x - size);
  }
  /// f in [L, 1 + L).
  template <class Real>
  static void weights(Real f, Real size, Real (&w)[3], Real (&dw)[3]) {
    const Real L = size, u = f - Real(1), low = Real(1) + L - f, high = f + L - Real(1);
    const bool near_first = f < Real(1) - L;  // on the straight part of the first node's hat
    w[0] = near_first ? Real(1) - f : low * low / (Real(4) * L);
    dw[0] = near_first ? Real(-1) : -low / (Real(2) * L);
    w[1] = u <= -L ? Real(1) + u : Real(1) - (u * u + L * L) / (Real(2) * L);
    dw[1] = u <= -L ? Real(1) : -u / L;
    w[2] = high > Real(0) ? high * high / (Real(4) * L) : Real(0);
    dw[2] = high > Real(0) ? high / (Real(2) * L) : Real(0);
  }
};

/// Quadratic B-spline: 3/4 - u^2 for |u| < 1/2, (3/2 - |u|)^2/2 for |u| < 3/2.
struct QuadraticKernel {
  static constexpr int nodes = 3;
  static constexpr double sort_offset = 0.5, farthest_drift = 0.95;
  static constexpr bool affine = true, sized = false;
  static constexpr double inverse_inertia = 4;

  template <class Real>
  static Real first_node(Real x, Real) {
    return std::floor(x - Real(0.5));
  }
  /// f in [1/2, 3/2).
  template <class Real>
  static void weights(Real f, Real, Real (&w)[3], Real (&dw)[3]) {
    const Real a = Real(1.5) - f, b = f - Real(1), c = f - Real(0.5);
    w[0] = Real(0.5) * a * a;
    w[1] = Real(0.75) - b * b;
    w[2] = Real(0.5) * c * c;
    dw[0] = -a;
    dw[1] = Real(-2) * b;
    dw[2] = c;
  }
};

/// Cubic B-spline: |u|^3/2 - u^2 + 2/3 for |u| < 1, (2 - |u|)^3/6 for |u| < 2.
struct CubicKernel {
  static constexpr int nodes = 4;
  static constexpr double sort_offset = 1, farthest_drift = 0;
  static constexpr bool affine = true, sized = false;
  static constexpr double inverse_inertia = 3;

  template <class Real>
  static Real first_node(Real x, Real) {
    return std::floor(x - Real(1));
  }
  /// f in [1, 2).
  template <class Real>
  static void weights(Real f, Real, Real (&w)[4], Real (&dw)[4]) {
    const Real a = f - Real(1), b = Real(2) - f;
    w[0] = b * b * b / Real(6);
    w[1] = (Real(0.5) * a - Real(1)) * a * a + Real(2) / Real(3);
    w[2] = (Real(0.5) * b - Real(1)) * b * b + Real(2) / Real(3);
    w[3] = a * a * a / Real(6);
    dw[0] = Real(-0.5) * b * b;
    dw[1] = (Real(1.5) * a - Real(2)) * a;
    dw[2] = -(Real(1.5) * b - Real(2)) * b;
    dw[3] = Real(0.5) * a * a;
  }
};

}  // namespace firn
