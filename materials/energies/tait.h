// A weakly compressible fluid: Tait's equation (Cole 1948; Tampubolon et al. 2017), and the elastic part of
// its viscous stress.
//
//   p = lam/7 (J^-7 - 1),    psi = lam/7 (J^-6 / 6 + J - 7/6) + mu/2 (tr b_bar - d)
//   tau = -p J I + mu dev(b_bar)
//
// lam: the bulk modulus at rest, Pa. mu: the shear modulus before the stress relaxes, Pa; 0 without
// viscosity. psi in J per m^3 at rest, tau in Pa, positive in tension. Stretched, the fluid pulls with lam/7
// at most. Below J = 0.2, where the pressure is 11,000 times the modulus, the volume stands still; counted in
// `capped`.
#pragma once

#include "materials/energies/isochoric_neo_hookean.h"

namespace firn {

struct TaitEnergy {
  static constexpr std::string_view name = "Tait";
  static constexpr double kLeastVolume = 0.2;

  template <class L>
  static L volume(L J) {
    return max(L(kLeastVolume), abs(J));  // a NaN stays one
  }
  template <class L>
  static L inverse_sixth(L J) {
    const L cube = J * J * J;
    return L(1) / (cube * cube);
  }

  template <class L, int D>
  static L density(const Vector<L, D>& s, const Lame<L>& m) {
    const L J = volume(product(s));
    const L shape = IsochoricNeoHookeanEnergy::shape_factor<D>(product(s)) * dot(s, s) - L(D);
    return m.lam * L(1.0 / 7) * (L(1.0 / 6) * inverse_sixth(J) + J - L(7.0 / 6)) + L(0.5) * m.mu * shape;
  }
  template <class L, int D>
  static Vector<L, D> kirchhoff(const Vector<L, D>& s, const Lame<L>& m) {
    const L shear = m.mu * IsochoricNeoHookeanEnergy::shape_factor<D>(product(s));
    const L mean = volumetric(volume(product(s)), m) - shear * L(1.0 / D) * dot(s, s);
    Vector<L, D> tau;
    for (int k = 0; k < D; ++k) tau[k] = shear * s[k] * s[k] + mean;
    return tau;
  }
  /// lam J^-6 and, of mu, what IsochoricNeoHookeanEnergy has.
  template <class L, int D>
  static L wave_modulus(const Vector<L, D>& s, const Lame<L>& m) {
    const Lame<L> shear = {m.mu, L(-2.0 / D) * m.mu};
    return fluid_modulus(volume(product(s)), m) + IsochoricNeoHookeanEnergy::wave_modulus(s, shear);
  }
  template <class L, int D>
  static L capped(const Vector<L, D>& s) {
    return select(product(s) < L(kLeastVolume), L(1), L(0));
  }

  /// -p J, Pa.
  template <class L>
  static L volumetric(L J, const Lame<L>& m) {
    return m.lam * L(1.0 / 7) * (J - inverse_sixth(J));
  }
  /// Falls with J; never below a millionth, so that spray keeps a finite time step.
  template <class L>
  static L fluid_modulus(L J, const Lame<L>& m) {
    return m.lam * max(inverse_sixth(J), L(1e-6));
  }

  template <int D>
  static PrincipalDerivatives<D> derivatives(const Vector<double, D>& s, const Lame<double>& m) {
    // The shear part as in a neo-Hookean solid without bulk modulus.
    PrincipalDerivatives<D> out = IsochoricNeoHookeanEnergy::derivatives(s, {m.mu, -2.0 / D * m.mu});
    const double J = volume(product(s)), mean = volumetric(J, m);
    const double slope = m.lam / 7 * (J + 6 * inverse_sixth(J));  // of `mean` in ln J
    for (int i = 0; i < D; ++i) {
      out.p[i] += mean / s[i];
      for (int j = 0; j < D; ++j) {
        // slope - mean on the diagonal, without the difference.
        out.H(i, j) += (i == j ? m.lam * inverse_sixth(J) : slope) / (s[i] * s[j]);
        if (j == i) continue;
        out.minus(i, j) -= mean / (s[i] * s[j]);
        out.plus(i, j) += mean / (s[i] * s[j]);
      }
    }
    return out;
  }
};

}  // namespace firn
