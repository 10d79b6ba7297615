// Cohesive Cam-clay (Gaume et al. 2018; Wolper et al. 2019, "NACC"): an ellipse in pressure and shear stress
// that grows as matter is compacted and shrinks as it comes apart.
//
//   p = -kappa/2 (J^2 - 1),  s = mu dev(b_bar)        Pa; p positive in compression
//   p0 = kappa (1e-5 + sinh(xi max(-alpha, 0)))       Pa; alpha: logarithmic plastic volume, < 0 compacted
//   (6 - d)/2 (1 + 2 beta) |s|^2 + M^2 (p + beta p0) (p - p0) <= 0
//
// Beyond the ends of the ellipse, p > p0 and p < -beta p0, the point goes to the tip, J with it and alpha by
// ln(J / J_tip). Between them s goes straight down to the ellipse. The volume then is kept exactly: the mean
// of b_bar is solved for. As published ("published") tr b is kept instead, by which J changes by 1.005
// to 1.45 in ordinary shear. alpha changes by ln(J / J_x), J_x the volume where the line from the ellipse's
// centre to the trial state crosses it.
//
// Public variants write xi sinh(x) for sinh(xi x) and measure shear otherwise; this is the form of the papers
// above. The argument of sinh stops at 10: p cannot exceed kappa/2, and p0 is then 11,000 kappa.
#pragma once

#include <string>

#include "materials/energies/isochoric_neo_hookean.h"
#include "materials/material_point.h"
#include "materials/unimodular.h"

namespace firn {

struct CohesiveCamClay {
  static constexpr std::string_view name = "cohesive Cam-clay", hardening_name = "plastic volume",
                                    rate_name = "none";
  template <class Energy>
  static constexpr bool valid_with = std::same_as<Energy, IsochoricNeoHookeanEnergy>;
  template <class L>
  using History = HardeningHistory<L>;

  double M, beta, xi;  // -
  double alpha_0;      // alpha at the start
  bool keeps_volume;   // else as published

  History<double> initial() const { return {alpha_0}; }

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s, const Lame<L>& m, History<L>& h, L) const {
    const Trial<L, D> trial(*this, s, m, h);
    const LaneMask<L> at_tip = trial.crushed() | trial.torn(), sheared = trial.sheared() & !at_tip;
    const LaneMask<L> moves = at_tip | sheared;
    if (!any(moves)) return s;
    const L J_tip = trial.volume_at(select(trial.crushed(), trial.p0, trial.least_p));
    const L at_rest = root<D>(J_tip);
    const Vector<L, D> ellipse = trial.b.shortened(trial.kept(), keeps_volume);
    Vector<L, D> out;
    for (int k = 0; k < D; ++k) out[k] = select(at_tip, at_rest, select(sheared, ellipse[k], s[k]));
    const L J_x = select(at_tip, J_tip, trial.volume_at(trial.crossing()));
    h.alpha = h.alpha + select(moves, log(trial.b.J / J_x), L(0));
    return out;
  }

  template <int D>
  std::string branch(const Vector<double, D>& s, const Lame<double>& m, History<double> h, double) const {
    const Trial<double, D> trial(*this, s, m, h);
    if (trial.crushed()) return "tip_compress";
    if (trial.torn()) return "tip_tension";
    return trial.sheared() ? "shear" : "elastic";
  }

  /// p0, Pa.
  template <class L>
  L compressive_strength(const L& kappa, const L& alpha) const {
    const L x = clamp(L(-xi) * alpha, L(0), L(10));
    // The difference of the exponentials loses the digits of a small argument; this series has them below
    // 0.1.
    const L x2 = x * x;
    const L series = x * (L(1) + x2 * (L(1.0 / 6) + x2 * (L(1.0 / 120) + x2 * L(1.0 / 5040))));
    const L up = exp(x);
    return kappa * (L(1e-5) + select(x < L(0.1), series, L(0.5) * (up - L(1) / up)));
  }

 private:
  template <class L, int D>
  struct Trial {
    UnimodularB<L, D> b;
    L kappa, p, p0, least_p, shear2, M;  // shear2: (6 - d)/2 (1 + 2 beta) |s|^2, Pa^2

    Trial(const CohesiveCamClay& clay, const Vector<L, D>& s, const Lame<L>& m, const History<L>& h)
        : b(s), kappa(IsochoricNeoHookeanEnergy::bulk_modulus<D>(m)), M(clay.M) {
      p = L(-0.5) * kappa * (b.J * b.J - L(1));
      p0 = clay.compressive_strength(kappa, h.alpha);
      least_p = -(L(clay.beta) * p0);
      shear2 = L((6 - D) / 2.0 * (1 + 2 * clay.beta)) * m.mu * m.mu * dot(b.dev, b.dev);
    }
    /// shear2 on the ellipse, Pa^2.
    L largest_shear2() const { return M * M * max((p - least_p) * (p0 - p), L(0)); }
    /// Of the deviator, straight down to the ellipse.
    L kept() const { return sqrt(largest_shear2() / max(shear2, L(1e-30))); }
    LaneMask<L> crushed() const { return p > p0; }
    LaneMask<L> torn() const { return p < least_p; }
    LaneMask<L> sheared() const { return shear2 > largest_shear2(); }
    /// The pressure where the line from the ellipse's centre to the trial state crosses it.
    L crossing() const {
      const L centre = L(0.5) * (p0 + least_p), radius = L(0.5) * (p0 - least_p), aside = p - centre;
      return centre + M * radius * aside / sqrt(shear2 + M * M * aside * aside + L(1e-30));
    }
    L volume_at(const L& pressure) const { return sqrt(max(L(1) - L(2) * pressure / kappa, L(1e-12))); }
  };

  template <int D, class L>
  static L root(const L& J) {
    return D == 1 ? J : exp(L(1.0 / D) * log(J));
  }
};

}  // namespace firn
