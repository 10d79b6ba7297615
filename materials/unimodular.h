// Principal values of a unimodular b (the product of its eigenvalues is 1) from its deviator: how a return
// map that shortens the deviator keeps the volume.
#pragma once

#include "materials/energies/isochoric_neo_hookean.h"
#include "materials/principal.h"

namespace firn {

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

/// b_bar = J^(-2/d) b in principal values, apart in mean and deviator, and the way back to stretches of the
/// same volume.
template <class L, int D>
struct UnimodularB {
  L J, scale, mean;  // scale: J^(-2/d)
  Vector<L, D> dev;

  explicit UnimodularB(const Vector<L, D>& s)
      : J(product(s)), scale(IsochoricNeoHookeanEnergy::shape_factor<D>(J)) {
    Vector<L, D> b;
    for (int k = 0; k < D; ++k) b[k] = scale * s[k] * s[k];
    mean = L(1.0 / D) * sum(b);
    dev = deviator(b);
  }

  /// With the deviator shortened to `kept` of it: J stays, or, as some papers have it, the mean of b_bar.
  Vector<L, D> shortened(const L& kept, bool keeps_volume) const {
    Vector<L, D> b = kept * dev;
    if (keeps_volume) {
      b = unimodular(b);
    } else {
      for (int k = 0; k < D; ++k) b[k] = b[k] + mean;
    }
    for (int k = 0; k < D; ++k) b[k] = sqrt(b[k] / scale);
    return b;
  }
};

}  // namespace firn
