// Shape functions of the grid, one axis; D axes are their product (equations after Steffen, Kirby & Berzins
// 2008).
#pragma once

namespace firn {

/// Quadratic B-spline with u = (x_p - x_i)/h: 3/4 - u^2 for |u| < 1/2, (3/2 - |u|)^2/2 for |u| < 3/2.
/// sum S = 1, sum S (x_i - x_p) = 0, sum S (x_i - x_p)^2 = h^2/4 at every position.
struct QuadraticKernel {
  static constexpr int nodes = 3;                   // per axis
  static constexpr double inverse_inertia = 4;      // h^2 D_p^-1
  static constexpr double first_node_offset = 0.5;  // the first node is floor(x/h - this)

  /// `f` = x/h - first node, in [1/2, 3/2): the weights of the three nodes and their derivatives by x/h.
  template <class Real>
  static void weights(Real f, Real (&w)[3], Real (&dw)[3]) {
    const Real a = Real(1.5) - f, b = f - Real(1), c = f - Real(0.5);
    w[0] = Real(0.5) * a * a;
    w[1] = Real(0.75) - b * b;
    w[2] = Real(0.5) * c * c;
    dw[0] = -a;
    dw[1] = Real(-2) * b;
    dw[2] = c;
  }
};

}  // namespace firn
