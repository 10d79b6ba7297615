// Fixed corotated elasticity (Stomakhin, Howes, Schroeder, Teran 2012; Stomakhin et al. 2013, eq. 1).
//
//   psi = mu sum_k (s_k - 1)^2 + lam/2 (J - 1)^2,     P = 2 mu (F - R) + lam (J - 1) J F^-T
//
// s: signed singular values of F, J = prod s_k, R the rotation of F's polar decomposition. psi in J per m^3
// at rest, stresses in Pa, positive in tension. Finite and restoring for every F, inverted and flat ones too:
// no floor. P jumps where s_i + s_j = 0 (an inverted element has two equally near rotations); a stiff volume
// term is quadratic in J, so it does not forbid J = 0.
#pragma once

#include "materials/principal.h"

namespace firn {

struct FixedCorotatedEnergy {
  static constexpr std::string_view name = "fixed corotated";

  template <class L, int D>
  static L density(const Vector<L, D>& s, const Lame<L>& m) {
    L squares = L(0);
    for (int k = 0; k < D; ++k) squares = squares + (s[k] - L(1)) * (s[k] - L(1));
    const L volume = product(s) - L(1);
    return m.mu * squares + L(0.5) * m.lam * volume * volume;
  }

  template <class L, int D>
  static Vector<L, D> kirchhoff(const Vector<L, D>& s, const Lame<L>& m) {
    const L J = product(s);
    const L pressure = m.lam * (J - L(1)) * J;
    Vector<L, D> tau;
    for (int k = 0; k < D; ++k) tau[k] = L(2) * m.mu * (s[k] - L(1)) * s[k] + pressure;
    return tau;
  }

  /// max_k s_k^2 d2psi/ds_k^2 = 2 mu max s^2 + lam J^2, which bounds the shear moduli 2 mu s_i^2 (1 - 1/(s_i
  /// + s_j)) too; never below mu, so that a collapsed point keeps a finite time step.
  template <class L, int D>
  static L wave_modulus(const Vector<L, D>& s, const Lame<L>& m) {
    return wave_modulus(largest_square(s), product(s), m);
  }
  /// The same from a bound on the squares s_k^2 and J.
  template <class L>
  static L wave_modulus(L largest_square, L J, const Lame<L>& m) {
    return max(L(2) * m.mu * largest_square + m.lam * J * J, m.mu);
  }

  /// tau = 2 mu (F - R) F^T + lam (J - 1) J I, the same without singular values: R is F's rotation.
  template <class L>
  static Matrix<L, 3> kirchhoff(const Matrix<L, 3>& F, const Matrix<L, 3>& R, L J, const Lame<L>& m) {
    const Matrix<L, 3> P = L(2) * m.mu * (F - R);
    Matrix<L, 3> tau;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        tau(i, j) = tau(j, i) = P(i, 0) * F(j, 0) + P(i, 1) * F(j, 1) + P(i, 2) * F(j, 2);
    const L pressure = m.lam * (J - L(1)) * J;
    for (int i = 0; i < 3; ++i) tau(i, i) = tau(i, i) + pressure;
    return tau;
  }

  template <class L, int D>
  static L capped(const Vector<L, D>&) {
    return L(0);
  }

  template <int D>
  static PrincipalDerivatives<D> derivatives(const Vector<double, D>& s, const Lame<double>& m) {
    PrincipalDerivatives<D> out{};
    const double volume = product(s) - 1;
    for (int i = 0; i < D; ++i) {
      const double J_i = product_without(s, i);
      out.p[i] = 2 * m.mu * (s[i] - 1) + m.lam * volume * J_i;
      out.H(i, i) = 2 * m.mu + m.lam * J_i * J_i;
      for (int j = 0; j < D; ++j) {
        if (j == i) continue;
        const double J_ij = product_without(s, i, j);
        out.H(i, j) = m.lam * (J_i * product_without(s, j) + volume * J_ij);
        out.minus(i, j) = 2 * m.mu - m.lam * volume * J_ij;
        out.plus(i, j) = 2 * m.mu * (1 - 2 / away_from_zero(s[i] + s[j], 1e-12)) + m.lam * volume * J_ij;
      }
    }
    return out;
  }
};

}  // namespace firn
