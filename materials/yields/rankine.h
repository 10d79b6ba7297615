// Rankine's tension cut-off in logarithmic strain: no principal stress exceeds the strength T, which fades
// with the opening alpha,
//
//   tau_k = 2 mu e_k + lam tr e <= T(alpha) = T_0 exp(-alpha / alpha_s),     e = ln s
//
// The closest-point return (in the elastic energy) opens the axes by x_k >= 0 with tau_k - 2 mu x_k - lam sum
// x = T where x_k > 0. Its sum is the largest, over all sets A of axes, of sum_A (tau_k - T) / (2 mu + |A|
// lam): no order of the axes is needed. alpha grows by sum x; T follows by a fixed point. alpha_s = infinity:
// no softening. Compression is elastic; an opening that closes again presses before it is shut.
#pragma once

#include <string>

#include "materials/energies/stvk_hencky.h"
#include "materials/material_point.h"

namespace firn {

struct Rankine {
  static constexpr std::string_view name = "Rankine", hardening_name = "exponential softening",
                                    rate_name = "none";
  template <class Energy>
  static constexpr bool valid_with = std::same_as<Energy, StvkHenckyEnergy>;
  template <class L>
  using History = HardeningHistory<L>;

  double T_0, alpha_s;  // Pa, -

  History<double> initial() const { return {0}; }

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s, const Lame<L>& m, History<L>& h, L) const {
    const Vector<L, D> e = StvkHenckyEnergy::strain(s), tau = StvkHenckyEnergy::kirchhoff(s, m);
    L T = strength(h.alpha);
    L most = tau[0];
    for (int k = 1; k < D; ++k) most = max(tau[k], most);
    const LaneMask<L> opens = most > T;
    if (!any(opens)) return s;
    L sum_x = opening(tau, T, m);
    for (int round = 0; round < kRounds; ++round) {
      T = strength(h.alpha + sum_x);
      sum_x = opening(tau, T, m);
    }
    Vector<L, D> out;
    for (int k = 0; k < D; ++k) {
      const L x = max((tau[k] - m.lam * sum_x - T) / (L(2) * m.mu), L(0));
      out[k] = select(opens, exp(e[k] - x), s[k]);
    }
    h.alpha = h.alpha + select(opens, sum_x, L(0));
    return out;
  }

  template <int D>
  std::string branch(const Vector<double, D>& s, const Lame<double>& m, History<double> h, double dt) const {
    return any(differs(project(s, m, h, dt), s)) ? "open" : "elastic";
  }

  template <class L>
  L strength(const L& alpha) const {
    return L(T_0) * exp(-(alpha * L(1 / alpha_s)));
  }

 private:
  // Each round the strength is right to a factor |T'| / (2 mu + lam) more.
  static constexpr int kRounds = 6;

  template <class L, int D>
  static L opening(const Vector<L, D>& tau, const L& T, const Lame<L>& m) {
    L out = L(0);
    for (int set = 1; set < (1 << D); ++set) {
      L over = L(0);
      int axes = 0;
      for (int k = 0; k < D; ++k) {
        if (!(set >> k & 1)) continue;
        over = over + (tau[k] - T);
        ++axes;
      }
      out = max(over / (L(2) * m.mu + L(axes) * m.lam), out);
    }
    return out;
  }
};

}  // namespace firn
