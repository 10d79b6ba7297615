// Herschel-Bulkley viscoplasticity of foams and pastes (Yue et al. 2015; Ram et al. 2015 with sigma_y = 0):
// above its yield stress matter flows the faster the more it is loaded.
//
//   s = mu |dev b_bar|, Y = sqrt(2/3) sigma_y      Pa
//   s + 2 mu_hat dt ((s - Y) / eta)^(1/h) = s_trial,   mu_hat = mu tr b_bar / d
//
// In steady flow |dev tau| = Y + eta |dev D|^h: with h = 1 eta is twice Newton's viscosity. eta in Pa s^h, h
// > 0: h = 1 is Bingham's fluid (and, with sigma_y = 0, one of Maxwell), h < 1 thins as it is sheared. dev
// b_bar keeps its direction. eta -> 0 is rate-independent, eta -> infinity elastic. The volume is kept
// exactly: the mean of b_bar is solved for. As published ("published") tr b_bar is kept, and J changes.
#pragma once

#include <string>

#include "materials/energies/isochoric_neo_hookean.h"
#include "materials/material_point.h"
#include "materials/unimodular.h"

namespace firn {

struct HerschelBulkley {
  static constexpr std::string_view name = "von Mises", hardening_name = "none",
                                    rate_name = "Herschel-Bulkley";
  template <class Energy>
  static constexpr bool valid_with = std::same_as<Energy, IsochoricNeoHookeanEnergy>;
  template <class L>
  using History = NoHistory<L>;

  double sigma_y, eta, h;  // Pa, Pa s^h, -
  bool keeps_volume;       // else as published

  History<double> initial() const { return {}; }

  template <class L, int D>
  Vector<L, D> project(const Vector<L, D>& s, const Lame<L>& m, History<L>&, L dt) const {
    const UnimodularB<L, D> b(s);
    const L trial = m.mu * norm(b.dev), threshold = L(std::sqrt(2.0 / 3) * sigma_y);
    const LaneMask<L> flows = (trial > threshold) & (dt > L(0));
    if (!any(flows)) return s;
    const L excess = overstress(max(trial - threshold, L(1e-30)), L(2) * m.mu * b.mean * dt);
    const Vector<L, D> flowed = b.shortened((threshold + excess) / max(trial, L(1e-30)), keeps_volume);
    Vector<L, D> out;
    for (int k = 0; k < D; ++k) out[k] = select(flows, flowed[k], s[k]);
    return out;
  }

  template <int D>
  std::string branch(const Vector<double, D>& s, const Lame<double>& m, History<double> none,
                     double dt) const {
    return any(differs(project(s, m, none, dt), s)) ? "flow" : "elastic";
  }

  /// x > 0 with x + c (x / eta)^(1/h) = X.
  template <class L>
  L overstress(const L& X, const L& c) const {
    if (h == 1) return X / (L(1) + c * L(1 / eta));
    // With x = eta exp(h u): ln(eta exp(h u) + c exp(u)) = ln X. The left side is convex in u and rises with
    // a slope between 1 and h; where either term alone is X it is too large by ln 2 at most, and Newton's
    // steps come down on it.
    const L log_X = log(X), log_c = log(max(c, L(1e-30)));
    const double log_eta = std::log(eta);
    L u = min((log_X - L(log_eta)) * L(1 / h), log_X - log_c);
    for (int step = 0; step < kSteps; ++step) {
      const L solid = exp(L(log_eta) + L(h) * u - log_X), fluid = exp(log_c + u - log_X);
      const L both = solid + fluid;
      u = u - log(both) * both / (L(h) * solid + fluid);
    }
    return min(exp(L(log_eta) + L(h) * u), X);
  }

 private:
  // At round-off for h from 0.1 to 5 (tested).
  static constexpr int kSteps = 6;
};

}  // namespace firn
