// Quadratic energy in the logarithmic (Hencky) strain e_k = ln s_k (as in Klar et al. 2016).
//
//   psi = mu sum_k e_k^2 + lam/2 (sum_k e_k)^2,     tau_k = 2 mu e_k + lam sum_j e_j  in the axes U
//
// s: signed singular values of F. psi in J per m^3 at rest, tau in Pa, positive in tension.
// Valid for moderate stretches: it softens in tension, and beyond a stretch of e it is not elliptic.
//
// The strain is one of b = F F^T, which does not tell an inverted element from its mirror image: e_k = ln
// |s_k|, so an inverted point is stressed like its mirror image and no energy is created. At |s_k| <
// kLeastStretch the logarithm stands still. Both are counted in `capped`.
#pragma once

#include <cmath>

#include "materials/principal.h"

namespace firn {

struct StvkHenckyEnergy {
  static constexpr std::string_view name = "StVK-Hencky";

  /// Below what a product of doubles resolves beside 1, and a normal number in float.
  static constexpr double kLeastStretch = 1e-16;

  template <class L, int D>
  static Vector<L, D> strain(const Vector<L, D>& s) {
    Vector<L, D> e;
    for (int k = 0; k < D; ++k) e[k] = log(max(L(kLeastStretch), abs(s[k])));  // a NaN stays one
    return e;
  }

  template <class L, int D>
  static L density(const Vector<L, D>& s, const Lame<L>& m) {
    const Vector<L, D> e = strain(s);
    const L trace_e = sum(e);
    return m.mu * dot(e, e) + L(0.5) * m.lam * trace_e * trace_e;
  }

  template <class L, int D>
  static Vector<L, D> kirchhoff(const Vector<L, D>& s, const Lame<L>& m) {
    const Vector<L, D> e = strain(s);
    const L pressure = m.lam * sum(e);
    Vector<L, D> tau;
    for (int k = 0; k < D; ++k) tau[k] = L(2) * m.mu * e[k] + pressure;
    return tau;
  }

  /// max_k s_k^2 d2psi/ds_k^2 = 2 mu + lam - min_k tau_k. Under strong tension the shear waves are faster:
  /// their modulus 2 mu x / (1 - exp(-2x)), x = e_i - e_j, is at most mu (1 + 2x), which also keeps the
  /// result at or above mu.
  template <class L, int D>
  static L wave_modulus(const Vector<L, D>& s, const Lame<L>& m) {
    const Vector<L, D> e = strain(s);
    L least = e[0], most = e[0];
    for (int k = 1; k < D; ++k) {
      least = min(e[k], least);
      most = max(e[k], most);
    }
    const L least_tau = L(2) * m.mu * least + m.lam * sum(e);
    const L shear = m.mu * (L(1) + L(2) * (most - least));
    return max(m.p_wave() - least_tau, shear);
  }

  template <class L, int D>
  static L capped(const Vector<L, D>& s) {
    return select(firn::least(s) < L(kLeastStretch), L(1), L(0));
  }

  template <int D>
  static PrincipalDerivatives<D> derivatives(const Vector<double, D>& signed_s, const Lame<double>& m) {
    PrincipalDerivatives<D> out{};
    Vector<double, D> s;
    for (int k = 0; k < D; ++k) s[k] = away_from_zero(signed_s[k], kLeastStretch);
    const Vector<double, D> tau = kirchhoff(s, m);
    for (int i = 0; i < D; ++i) {
      out.p[i] = tau[i] / s[i];
      for (int j = 0; j < D; ++j) {
        out.H(i, j) = (m.lam + (i == j ? 2 * m.mu - tau[i] : 0)) / (s[i] * s[j]);
        if (j == i) continue;
        out.minus(i, j) = (2 * m.mu * weighted_log_quotient(s[i], s[j]) - tau[j]) / (s[i] * s[j]);
        out.plus(i, j) = (tau[j] - 2 * m.mu * weighted_log_quotient(s[i], -s[j])) / (s[i] * s[j]);
      }
    }
    return out;
  }

 private:
  // b (ln|a| - ln|b|) / (a - b) without cancellation; 1 at a = b.
  static double weighted_log_quotient(double a, double b) {
    const double x = (a - b) / b;
    if (x == 0) return 1;
    const double l = x > -0.5 ? std::log1p(x) : std::log(std::fabs(a / b));
    return l / x;
  }
};

}  // namespace firn
