// Neo-Hookean elasticity with change of shape and of volume apart (as in Yue et al. 2015 and Wolper et al.
// 2019, after Simo).
//
//   psi = kappa/2 ((J^2 - 1)/2 - ln J) + mu/2 (tr b_bar - d),     b_bar = J^(-2/d) F F^T,  J = det F
//   tau = kappa/2 (J^2 - 1) I + mu dev(b_bar),                    kappa = lam + 2 mu / d
//
// psi in J per m^3 at rest, tau (Kirchhoff) in Pa, positive in tension. A return map that keeps J changes the
// second term alone. kappa is the bulk modulus of a d-dimensional solid. The barrier at J -> 0 is a
// logarithm, and the pressure -tr tau / d stays below kappa / 2.
//
// The strain is one of F F^T: an inverted point is stressed like its mirror image. At |J| < kLeastVolume the
// volume stands still. Both are counted in `capped`.
#pragma once

#include "materials/principal.h"

namespace firn {

struct IsochoricNeoHookeanEnergy {
  static constexpr std::string_view name = "isochoric neo-Hookean";

  /// Far below any volume ratio a simulation resolves, and its square is a normal number in float.
  static constexpr double kLeastVolume = 1e-18;

  template <int D, class L>
  static L bulk_modulus(const Lame<L>& m) {
    return m.lam + L(2.0 / D) * m.mu;
  }
  template <class L>
  static L volume(L J) {
    return max(L(kLeastVolume), abs(J));  // a NaN stays one
  }
  /// |J|^(-2/d): what makes b unimodular.
  template <int D, class L>
  static L shape_factor(L J) {
    if constexpr (D == 1) return L(1) / (volume(J) * volume(J));
    if constexpr (D == 2) return L(1) / volume(J);
    return exp(L(-2.0 / 3) * log(volume(J)));
  }

  template <class L, int D>
  static L density(const Vector<L, D>& s, const Lame<L>& m) {
    const L J = volume(product(s));
    const L shape = shape_factor<D>(J) * dot(s, s) - L(D);
    return L(0.5) * (bulk_modulus<D>(m) * (L(0.5) * (J * J - L(1)) - log(J)) + m.mu * shape);
  }

  template <class L, int D>
  static Vector<L, D> kirchhoff(const Vector<L, D>& s, const Lame<L>& m) {
    const L J = volume(product(s));
    const L shear = m.mu * shape_factor<D>(J);
    const L mean = L(0.5) * bulk_modulus<D>(m) * (J * J - L(1)) - shear * L(1.0 / D) * dot(s, s);
    Vector<L, D> tau;
    for (int k = 0; k < D; ++k) tau[k] = shear * s[k] * s[k] + mean;
    return tau;
  }

  /// max_k s_k^2 d2psi/ds_k^2 = kappa/2 (J^2 + 1) + mu J^(-2/d) ((2/d + 1)/d tr b + max_k (1 - 4/d) s_k^2),
  /// and the shear moduli mu J^(-2/d) s_k^2.
  template <class L, int D>
  static L wave_modulus(const Vector<L, D>& s, const Lame<L>& m) {
    const L J = volume(product(s));
    const L shear = m.mu * shape_factor<D>(J);
    L least_square = s[0] * s[0];
    for (int k = 1; k < D; ++k) least_square = min(s[k] * s[k], least_square);
    const L pressure_wave = L(0.5) * bulk_modulus<D>(m) * (J * J + L(1)) +
                            shear * (L((2.0 / D + 1) / D) * dot(s, s) + L(1 - 4.0 / D) * least_square);
    return max(pressure_wave, shear * largest_square(s));
  }

  template <class L, int D>
  static L capped(const Vector<L, D>& s) {
    return select(product(s) < L(kLeastVolume), L(1), L(0));
  }

  template <int D>
  static PrincipalDerivatives<D> derivatives(const Vector<double, D>& signed_s, const Lame<double>& m) {
    PrincipalDerivatives<D> out{};
    Vector<double, D> s;
    for (int k = 0; k < D; ++k) s[k] = away_from_zero(signed_s[k], kLeastVolume);
    const double J = volume(product(s)), kappa = bulk_modulus<D>(m);
    const double shear = m.mu * shape_factor<D>(J), trace_b = dot(s, s);
    const double mean = 0.5 * kappa * (J * J - 1) - shear * trace_b / D;
    for (int i = 0; i < D; ++i) {
      out.p[i] = shear * s[i] + mean / s[i];
      for (int j = 0; j < D; ++j) {
        const double coupling = kappa * J * J - 2.0 / D * shear * (s[i] * s[i] + s[j] * s[j] - trace_b / D);
        out.H(i, j) = coupling / (s[i] * s[j]);
        if (j == i) out.H(i, i) += shear - mean / (s[i] * s[i]);
        if (j == i) continue;
        out.minus(i, j) = shear - mean / (s[i] * s[j]);
        out.plus(i, j) = shear + mean / (s[i] * s[j]);
      }
    }
    return out;
  }
};

}  // namespace firn
