// Von Mises plasticity in logarithmic strain: the classical radial return (Simo & Hughes 1998, section 3.3,
// in the Hencky strains of Simo 1992), exact for the exponential step.
//
//   q = sqrt(3/2) |dev tau| = sqrt(6) mu |dev e|  <=  sigma(alpha, rate),     e = ln s
//
// q, sigma in Pa; alpha is the equivalent plastic strain, its increment x the root of
// q - 3 mu x = sigma(alpha + x, x / dt). Volume is kept exactly: only dev e shrinks. In d dimensions dev is
// that of d x d matrices: a plane model is not plane strain.
#pragma once

#include <string>

#include "materials/energies/stvk_hencky.h"
#include "materials/hardening/isotropic.h"
#include "materials/material_point.h"
#include "materials/principal.h"
#include "materials/rates/rate.h"

namespace firn {

template <class HardeningLaw, class Rate = RateIndependent>
struct VonMises {
  static constexpr std::string_view name = "von Mises";
  static constexpr std::string_view hardening_name = HardeningLaw::name, rate_name = Rate::name;
  template <class Energy>
  static constexpr bool valid_with = std::same_as<Energy, StvkHenckyEnergy>;
  template <class L>
  using History = HardeningHistory<L>;

  HardeningLaw hardening;
  Rate rate;

  History<double> initial() const { return {0}; }

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s, const Lame<L>& m, History<L>& h, L dt) const {
    const Vector<L, D> e = StvkHenckyEnergy::strain(s), dev = deviator(e);
    const L n = norm(dev);
    const L q = L(std::sqrt(6.0)) * m.mu * n;
    const LaneMask<L> yields = q > hardening.stress(h.alpha);
    if (!any(yields)) return s;
    const L x = select(yields, increment(q, L(3) * m.mu, h.alpha, dt), L(0));
    // |dev e| goes by sqrt(3/2) x.
    const L kept = L(std::sqrt(1.5)) * x / max(n, L(1e-30));
    Vector<L, D> out;
    for (int k = 0; k < D; ++k) out[k] = select(yields, exp(e[k] - kept * dev[k]), s[k]);
    h.alpha = h.alpha + x;
    return out;
  }

  template <int D>
  std::string branch(const Vector<double, D>& s, const Lame<double>& m, History<double> h, double dt) const {
    return any(differs(project(s, m, h, dt), s)) ? "1" : "0";
  }

  /// The equivalent plastic strain of a step; 0 <= x <= (q - sigma) / 3 mu.
  template <class L>
  L increment(const L& q, const L& three_mu, const L& alpha, const L& dt) const {
    const L per_step = L(1) / max(dt, L(1e-30));
    const L excess = max(q - hardening.stress(alpha), L(0));
    if constexpr (HardeningLaw::linear && Rate::linear) {
      // Where H softens faster than the elastic stress falls, the point gives way at once.
      const L stiffness = three_mu + hardening.slope(alpha) + rate.stress(L(0), L(0)).by_rate * per_step;
      return min(excess / max(stiffness, L(1e-6) * three_mu), q / three_mu);
    } else {
      // Decreasing in x and of either sign at the ends: Newton's steps, halved where they leave the bracket.
      L low = L(0), high = excess / three_mu, x = L(0.5) * high;
      for (int step = 0; step < kSteps; ++step) {
        const L a = alpha + x;
        const RatedStress<L> flow = rate.stress(hardening.stress(a), x * per_step);
        const L left = q - three_mu * x - flow.value;
        const L slope = three_mu + hardening.slope(a) * flow.by_sigma + flow.by_rate * per_step;
        const LaneMask<L> more = left > L(0);
        low = select(more, x, low);
        high = select(more, high, x);
        const L newton = x + left / slope;
        x = select((newton >= low) & (newton <= high), newton, L(0.5) * (low + high));
      }
      return x;
    }
  }

 private:
  // Voce and Johnson-Cook are at round-off after 10 from the middle of the bracket (tested).
  static constexpr int kSteps = 16;
};

}  // namespace firn
