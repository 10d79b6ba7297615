// Plastic flow of Bargteil et al. 2007 (after Irving et al. 2004): a fraction of the isochoric stretch
// becomes plastic, the more the stress exceeds its limit.
//
//   s* = s J^(-1/d),   s <- s (s*)^(-gamma),   gamma = nu (|P| - P_Y - K alpha) / |P|, in [0, 1]
//
// |P|: length of the principal first Piola stress, Pa, pressure included; P_Y its limit, K hardening in Pa,
// alpha the accumulated length of ln((s*)^gamma). nu in [0, 1] is a fraction per step as published; here it
// is one per dt_ref, 1 - (1 - nu)^(dt / dt_ref) in a step of dt, so that the flow does not depend on the
// step.
#pragma once

#include <string>

#include "materials/material_point.h"
#include "materials/principal.h"

namespace firn {

template <PrincipalEnergy Energy>
struct BargteilFlow {
  static constexpr std::string_view name = "first Piola stress", hardening_name = "linear",
                                    rate_name = "Bargteil";
  template <class Other>
  static constexpr bool valid_with = std::same_as<Other, Energy>;
  template <class L>
  using History = HardeningHistory<L>;

  double P_Y, nu, K;  // Pa, -, Pa
  double dt_ref;      // s

  History<double> initial() const { return {0}; }

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s, const Lame<L>& m, History<L>& h, L dt) const {
    const L gamma = fraction(s, m, h, dt);
    const LaneMask<L> flows = gamma > L(0);
    if (!any(flows)) return s;
    Vector<L, D> e;
    for (int k = 0; k < D; ++k) e[k] = log(s[k]);
    const Vector<L, D> dev = deviator(e);
    Vector<L, D> out;
    for (int k = 0; k < D; ++k) out[k] = select(flows, s[k] * exp(-(gamma * dev[k])), s[k]);
    h.alpha = h.alpha + gamma * norm(dev);
    return out;
  }

  template <int D>
  std::string branch(const Vector<double, D>& s, const Lame<double>& m, History<double> h, double dt) const {
    return fraction(s, m, h, dt) > 0 ? "flow" : "elastic";
  }

  template <class L, int D>
  L fraction(const Vector<L, D>& s, const Lame<L>& m, const History<L>& h, const L& dt) const {
    const Vector<L, D> tau = Energy::kirchhoff(s, m);
    L square = L(0);
    for (int k = 0; k < D; ++k) square = square + (tau[k] / s[k]) * (tau[k] / s[k]);
    const L P = sqrt(square);
    const L excess = (P - L(P_Y) - L(K) * h.alpha) / max(P, L(1e-30));
    const L per_step = L(1) - exp(L(std::log1p(-nu) / dt_ref) * dt);
    return clamp(per_step * excess, L(0), L(1));
  }
};

}  // namespace firn
