// Compressible neo-Hookean elasticity (in the logarithmic form of Bonet and Wood 1997).
//
//   psi = mu/2 (tr b - d) - mu ln J + lam/2 (ln J)^2,     tau = mu (b - I) + lam ln J I,     b = F F^T, J =
//   det F
//
// psi in J per m^3 at rest, tau (Kirchhoff) in Pa, positive in tension. Stress and energy need b and J only:
// no decomposition and no root. The barrier at J -> 0 is a logarithm.
//
// b and J^2 = det b do not tell an inverted element from its mirror image: ln J means ln |J|, so an inverted
// point is stressed like its mirror image and no energy is created. At |J| < kLeastVolume the logarithm
// stands still. Both are counted in `capped`.
#pragma once

#include "materials/principal.h"

namespace firn {

struct NeoHookeanEnergy {
  static constexpr std::string_view name = "neo-Hookean";

  /// Far below any volume ratio a simulation resolves, and a normal number in float.
  static constexpr double kLeastVolume = 1e-30;

  template <class L>
  static L log_volume(L J) {
    return log(max(abs(J), L(kLeastVolume)));
  }

  /// From F itself.
  template <class L, int D>
  struct Direct {
    Matrix<L, D> tau;
    L wave_modulus, capped;
  };
  template <class L, int D>
  static Direct<L, D> direct_response(const Matrix<L, D>& F, const Lame<L>& m) {
    const L J = determinant(F);
    const L log_J = log_volume(J);
    const Matrix<L, D> b = F * transpose(F);
    Direct<L, D> out;
    out.tau = m.mu * b;
    for (int k = 0; k < D; ++k) out.tau(k, k) = out.tau(k, k) + (m.lam * log_J - m.mu);
    out.wave_modulus = modulus(largest_eigenvalue_bound(b), log_J, m);
    out.capped = capped_volume(J);
    return out;
  }
  template <class L, int D>
  static L direct_density(const Matrix<L, D>& F, const Lame<L>& m) {
    return density_of(frobenius2(F) - L(D), log_volume(determinant(F)), m);
  }

  /// The same from the singular values.
  template <class L, int D>
  static L density(const Vector<L, D>& s, const Lame<L>& m) {
    return density_of(dot(s, s) - L(D), log_volume(product(s)), m);
  }
  template <class L, int D>
  static Vector<L, D> kirchhoff(const Vector<L, D>& s, const Lame<L>& m) {
    const L pressure = m.lam * log_volume(product(s));
    Vector<L, D> tau;
    for (int k = 0; k < D; ++k) tau[k] = m.mu * (s[k] * s[k] - L(1)) + pressure;
    return tau;
  }
  template <class L, int D>
  static L wave_modulus(const Vector<L, D>& s, const Lame<L>& m) {
    return modulus(largest_square(s), log_volume(product(s)), m);
  }
  template <class L, int D>
  static L capped(const Vector<L, D>& s) {
    return capped_volume(product(s));
  }

  template <int D>
  static PrincipalDerivatives<D> derivatives(const Vector<double, D>& signed_s, const Lame<double>& m) {
    PrincipalDerivatives<D> out{};
    Vector<double, D> s;
    for (int k = 0; k < D; ++k) s[k] = away_from_zero(signed_s[k], kLeastVolume);
    const double c = m.mu - m.lam * log_volume(product(signed_s));
    for (int i = 0; i < D; ++i) {
      out.p[i] = m.mu * s[i] - c / s[i];
      for (int j = 0; j < D; ++j) {
        const double inverse = 1 / (s[i] * s[j]);
        out.H(i, j) = m.lam * inverse + (i == j ? m.mu + c * inverse : 0);
        if (j == i) continue;
        out.minus(i, j) = m.mu + c * inverse;
        out.plus(i, j) = m.mu - c * inverse;
      }
    }
    return out;
  }

 private:
  template <class L>
  static L density_of(L trace_b_less_d, L log_J, const Lame<L>& m) {
    return m.mu * (L(0.5) * trace_b_less_d - log_J) + L(0.5) * m.lam * log_J * log_J;
  }

  // max_k s_k^2 d2psi/ds_k^2 = mu (s^2 + 1) + lam (1 - ln J). Where a large J makes that fall below the shear
  // modulus mu s^2, the shear wave is the faster one; never below mu, so that a collapsed point keeps a
  // finite time step.
  template <class L>
  static L modulus(L largest_s2, L log_J, const Lame<L>& m) {
    return m.mu * max(largest_s2, L(1)) + max(m.mu * min(largest_s2, L(1)) + m.lam * (L(1) - log_J), L(0));
  }

  // Gershgorin: no eigenvalue of b exceeds its largest absolute row sum. Exact at rest, at most sqrt(D) too
  // large.
  template <class L, int D>
  static L largest_eigenvalue_bound(const Matrix<L, D>& b) {
    L bound = L(0);
    for (int i = 0; i < D; ++i) {
      L row = abs(b(i, 0));
      for (int j = 1; j < D; ++j) row = row + abs(b(i, j));
      bound = max(row, bound);
    }
    return bound;
  }

  template <class L>
  static L capped_volume(L J) {
    return select(J < L(kLeastVolume), L(1), L(0));
  }
};

}  // namespace firn
