// Drucker-Prager plasticity of grains in logarithmic strain (Klar et al. 2016; Mast 2013). With e = ln s,
// t = tr e, n = |dev e| and K = lam + 2 mu / d,
//
//   2 mu n + d K a (t - t_0) <= 0
//
// a is the friction coefficient of the hardening, t_0 = p_t / K the strain at which grains part under the
// tension p_t (Pa; 0 is dry sand). Beyond it the point goes to the tip of the cone, without stress but p_t;
// beside the cone it goes straight down to it, which keeps the volume: no dilation. q (the history's alpha)
// grows by the length of the plastic strain.
//
// In d dimensions the deviator is that of d x d matrices. With phi = 30 degrees that gives tau/p = sqrt(2) a
// = 0.462 in plane models and 3 a / sqrt(2) = 0.693 in plane strain, which is d = 3: sand slides from 24.8
// and 34.7 degrees on.
//
// Volume (our form of the correction of Tampubolon et al. 2017): grains that parted and come together again
// must not press before they touch. v_c is the logarithmic volume by which the point is open; it is added to
// the trial strain, and there is pressure only once it is used up. Without it, sand that lands again and
// again swells.
//
// With a rate (Perzyna) the way to the cone is gone in part: x = excess / (1 + eta / (2 mu dt)).
#pragma once

#include <string>

#include "materials/energies/stvk_hencky.h"
#include "materials/hardening/friction_angle.h"
#include "materials/material_point.h"
#include "materials/principal.h"
#include "materials/rates/rate.h"

namespace firn {

template <class Rate = RateIndependent>
struct DruckerPrager {
  static constexpr std::string_view name = "Drucker-Prager";
  static constexpr std::string_view hardening_name = FrictionAngle::name, rate_name = Rate::name;
  template <class Energy>
  static constexpr bool valid_with = std::same_as<Energy, StvkHenckyEnergy>;
  template <class L>
  using History = GranularHistory<L>;

  FrictionAngle friction;
  Rate rate;
  double tensile_strength;  // p_t, Pa
  bool volume_correction;

  History<double> initial() const { return {0, 0}; }

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s, const Lame<L>& m, History<L>& h, L dt) const {
    const Trial<L, D> trial(*this, s, m, h);
    const LaneMask<L> open = trial.open(), slides = trial.slides(), moves = open | slides | trial.closes(h);
    if (!any(moves)) return s;
    const L x = select(slides, trial.excess / relaxation(m, dt), L(0));
    const L kept = L(1) - x / max(trial.n, L(1e-30));
    const L tip = L(1.0 / D) * trial.t_0;
    Vector<L, D> out;
    L to_tip = L(0);
    for (int k = 0; k < D; ++k) {
      const L aside = trial.e[k] - tip;
      to_tip = to_tip + aside * aside;
      const L cone = trial.mean + kept * trial.dev[k];
      out[k] = select(moves, exp(select(open, tip, cone)), s[k]);
    }
    h.alpha = h.alpha + select(open, sqrt(to_tip), x);
    h.volume_gain = volume_correction ? select(open, trial.t - trial.t_0, L(0)) : L(0);
    return out;
  }

  template <int D>
  std::string branch(const Vector<double, D>& s, const Lame<double>& m, History<double> h, double) const {
    const Trial<double, D> trial(*this, s, m, h);
    return trial.open() ? "tip" : trial.slides() ? "cone" : "elastic";
  }

 private:
  template <class L, int D>
  struct Trial {
    Vector<L, D> e, dev;
    L t, t_0, mean, n, excess;

    Trial(const DruckerPrager& sand, const Vector<L, D>& s, const Lame<L>& m, const History<L>& h)
        : e(StvkHenckyEnergy::strain(s)), dev(deviator(e)) {
      const L bulk = m.lam + L(2.0 / D) * m.mu;
      t = sum(e) + h.volume_gain;
      t_0 = L(sand.tensile_strength) / bulk;
      mean = L(1.0 / D) * t;
      n = norm(dev);
      excess = n + L(0.5 * D) * bulk / m.mu * sand.friction.slope(h.alpha) * (t - t_0);
    }
    // The round-off of a shear that keeps the volume opens nothing.
    LaneMask<L> open() const {
      return t - t_0 > L(8 * static_cast<double>(std::numeric_limits<LaneReal<L>>::epsilon())) * n;
    }
    LaneMask<L> slides() const { return (excess > L(0)) & !open(); }
    LaneMask<L> closes(const History<L>& h) const { return h.volume_gain > L(0); }
  };

  template <class L>
  L relaxation(const Lame<L>& m, const L& dt) const {
    if constexpr (std::same_as<Rate, RateIndependent>) return L(1);
    return L(1) + rate.stress(L(0), L(0)).by_rate / max(L(2) * m.mu * dt, L(1e-30));
  }
};

}  // namespace firn
