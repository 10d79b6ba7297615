// Multiplicative plasticity F = F_E F_P from three parts: the energy gives psi and the stress of F_E, the
// yield set projects F_E's singular values, hardening scales the moduli with F_P. One decomposition per
// update.
//
// The projection s -> s* is written as an increment, F_E += U (s* - s) V^T and F_P += V (s/s* - 1) V^T F_P:
// F_E F_P is unchanged, an elastic step changes no bit, and round-off does not drift as it does when F_E is
// rebuilt from its factors each step. The yield set must keep s* away from 0.
//
// `dissipated` is the stored energy before the projection less that after it, each with the moduli of its
// F_P. It is not negative for small increments; a single step that crushes a point by tens of percent may
// harden it so much that it stores more than the trial state did.
#pragma once

#include "engine/math/svd.h"
#include "materials/near_rest.h"

namespace firn {

template <class EnergyPart, class YieldPart, class HardeningPart>
requires PrincipalEnergy<EnergyPart> && YieldFor<YieldPart, EnergyPart> && Hardening<HardeningPart>
struct ElastoPlastic {
  using Energy = EnergyPart;
  template <class L, int D>
  using Point = PlasticPoint<L, D>;
  static constexpr std::string_view yield_name = YieldPart::name, hardening_name = HardeningPart::name;
  static constexpr std::string_view decomposition = "SVD";

  double density;       // kg/m^3 at rest
  Lame<double> moduli;  // Pa, before hardening
  YieldPart yield;
  HardeningPart hardening;

  template <class L, int D>
  PlasticPoint<L, D> at_rest() const {
    return {Matrix<L, D>::identity(), Matrix<L, D>::identity()};
  }

  template <class L, int D>
  Response<L, D> update(PlasticPoint<L, D>& p, L) const {
    if constexpr (kHasNearRest<Energy, L, D>) {
      const NearRotation<L> near(p.F_E);
      const LaneMask<L> elastic = near.valid() & yield.holds_squares(near.least_square, near.largest_square);
      if (!any(elastic)) return project(p);
      const auto hardened = hardening.evaluate(determinant(p.F_P));
      const Lame<L> rest = moduli.as<L>();
      Response<L, D> out = response_near_rest<Energy>(p.F_E, near, hardened.factor * rest);
      out.wave_modulus = max(out.wave_modulus, least_wave_modulus(rest));
      out.capped = hardened.capped;
      if (!any(!elastic)) return out;
      const PlasticPoint<L, D> before = p;
      out = chosen(elastic, out, project(p));
      p.F_E = chosen(elastic, before.F_E, p.F_E);
      p.F_P = chosen(elastic, before.F_P, p.F_P);
      return out;
    } else {
      return project(p);
    }
  }

  /// `update` by singular values, wherever the point is.
  template <class L, int D>
  Response<L, D> project(PlasticPoint<L, D>& p) const {
    const Lame<L> rest = moduli.as<L>();
    const Svd<L, D> f = svd_any_order(p.F_E);
    const Vector<L, D> s = yield.project(f.s);
    L J_P = determinant(p.F_P);
    auto hardened = hardening.evaluate(J_P);
    Response<L, D> out;
    out.dissipated = L(0);
    // Most steps of most points are elastic; what follows would change no bit of them.
    if (any(differs(s, f.s))) {
      const L psi_trial = Energy::density(f.s, hardened.factor * rest);
      Vector<L, D> plastic;
      for (int k = 0; k < D; ++k) {
        plastic[k] = (f.s[k] - s[k]) / s[k];
        J_P = J_P * (L(1) + plastic[k]);
      }
      p.F_E = p.F_E + compose(f.U, s - f.s, f.V);
      p.F_P = p.F_P + compose(f.V, plastic, f.V) * p.F_P;
      hardened = hardening.evaluate(J_P);
      out.dissipated = psi_trial - Energy::density(s, hardened.factor * rest);
    }
    const Lame<L> m = hardened.factor * rest;
    out.tau = compose(f.U, Energy::kirchhoff(s, m), f.U);
    out.wave_modulus = max(Energy::wave_modulus(s, m), least_wave_modulus(rest));
    out.capped = max(hardened.capped, Energy::capped(s));
    return out;
  }

  /// Moduli that faded to nothing still leave a time step: c stays above a thousandth of that at rest.
  template <class L>
  static L least_wave_modulus(const Lame<L>& rest) {
    return L(1e-6) * rest.p_wave();
  }

  template <class L, int D>
  L energy(const PlasticPoint<L, D>& p) const {
    return Energy::density(svd_any_order(p.F_E).s, current_moduli(p));
  }

  /// The moduli this point has now.
  template <class L, int D>
  Lame<L> current_moduli(const PlasticPoint<L, D>& p) const {
    return hardening.evaluate(determinant(p.F_P)).factor * moduli.as<L>();
  }
};

}  // namespace firn
