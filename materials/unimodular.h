// Principal values of a unimodular b (the product of its eigenvalues is 1) from its deviator: how a return
// map that shortens the deviator keeps the volume.
#pragma once

#include "materials/principal.h"

namespace firn {

/// x - mean(x).
template <class L, int D>
Vector<L, D> deviator(const Vector<L, D>& x) {
  const L mean = L(1.0 / D) * sum(x);
  Vector<L, D> out;
  for (int k = 0; k < D; ++k) out[k] = x[k] - mean;
  return out;
}

/// t > 0 with t (t + a) (t + b) = 1, for a, b >= 0. Each of 1, a^(-1/2), b^(-1/2) and 1/(ab) is too large,
/// and from above Newton's steps come down on the convex product; from the least of them few are needed.
template <class L>
L least_of_unit_product(L a, L b) {
  L t = min(L(1) / sqrt(max(max(a, b), L(1))), L(1) / max(a * b, L(1e-30)));
  for (int step = 0; step < 8; ++step) {
    const L x = t + a, y = t + b;
    t = t - (t * x * y - L(1)) / (x * y + t * (x + y));
  }
  return t;
}

/// The eigenvalues whose deviator is `dev` (which adds up to 0) and whose product is 1.
template <class L, int D>
Vector<L, D> unimodular(const Vector<L, D>& dev) {
  Vector<L, D> gap;
  const L low = least(dev);
  for (int k = 0; k < D; ++k) gap[k] = dev[k] - low;
  L t = L(1);
  if constexpr (D == 2) {
    const L g = gap[0] + gap[1];
    t = L(2) / (g + sqrt(g * g + L(4)));
  } else if constexpr (D == 3) {
    // One gap is 0; the other two, in any order.
    const L widest = max(max(gap[0], gap[1]), gap[2]);
    t = least_of_unit_product(widest, gap[0] + gap[1] + gap[2] - widest);
  }
  for (int k = 0; k < D; ++k) gap[k] = gap[k] + t;
  return gap;
}

}  // namespace firn
