// A weakly compressible fluid with viscosity (pressure: materials/energies/tait.h). A fluid forgets its
// shape: F_E holds the volume and, in its shape, what the viscous stress has not relaxed yet, and there is no
// F_P.
//
//   s (1 + mu_hat dt / eta) = s_trial,   s = mu |dev b_bar|, mu_hat = mu tr b_bar / d
//
// which is a fluid of Maxwell: in flows slower than mu / eta a Newtonian one, dev sigma = 2 eta dev D, stable
// for any viscosity (the shear waves of mu are part of the time step). mu is a tenth of the bulk modulus; a
// fluid without viscosity has mu = 0 and needs no decomposition.
#pragma once

#include "engine/math/svd.h"
#include "materials/describe.h"
#include "materials/energies/tait.h"
#include "materials/flow_plastic.h"
#include "materials/unimodular.h"

namespace firn {

struct Fluid {
  using Energy = TaitEnergy;
  template <class L, int D>
  using Point = ElasticPoint<L, D>;
  static constexpr std::string_view name = "fluid", yield_name = "none", hardening_name = "none";
  static constexpr std::string_view decomposition = "SVD";
  static constexpr double kShearRatio = 0.1;
  static constexpr double kLeastVolume = 1e-18;  // its pressure is that of TaitEnergy::kLeastVolume
  static constexpr Parameter parameters[] = {
      density_parameter(1000),
      {"bulk_modulus", "Pa", "resists compression; sound travels with its root over the density", 1e5, 0,
       1e15, true},
      {"viscosity", "Pa s", "eta: shear stress per rate of shear", 0, 0, 1e9},
  };

  double density;       // kg/m^3 at rest
  Lame<double> moduli;  // Pa
  double viscosity;     // Pa s

  static ModelInfo info() {
    return describe<Fluid>("weakly compressible fluid, with or without viscosity",
                           "pressure as in Tampubolon et al. 2017, after Tait; viscosity of Maxwell");
  }
  static Fluid make(const ParameterValues& v) {
    const double bulk = v.at("bulk_modulus"), eta = v.at("viscosity");
    return {v.at("density"), {eta > 0 ? kShearRatio * bulk : 0, bulk}, eta};
  }

  template <class L, int D>
  ElasticPoint<L, D> at_rest() const {
    return {Matrix<L, D>::identity()};
  }

  template <class L, int D>
  Response<L, D> update(ElasticPoint<L, D>& p, L dt) const {
    return viscosity > 0 ? update_viscous(p, dt) : update_inviscid(p);
  }

  template <class L, int D>
  L energy(const ElasticPoint<L, D>& p) const {
    return Energy::density(Stretches<L, D>(svd_any_order(p.F_E).s).s, moduli.as<L>());
  }
  template <class L, int D>
  Lame<L> current_moduli(const ElasticPoint<L, D>&) const {
    return moduli.as<L>();
  }

 private:
  template <class L, int D>
  Response<L, D> update_inviscid(ElasticPoint<L, D>& p) const {
    const Lame<L> m = moduli.as<L>();
    const L trial_J = determinant(p.F_E), J = max(L(kLeastVolume), abs(trial_J));
    p.F_E = Matrix<L, D>::scaled_identity(D == 1 ? J : exp(L(1.0 / D) * log(J)));
    const L pressed = Energy::volume(J);
    return {Matrix<L, D>::scaled_identity(Energy::volumetric(pressed, m)), Energy::fluid_modulus(pressed, m),
            L(0), select(trial_J == pressed, L(0), L(1))};
  }

  template <class L, int D>
  Response<L, D> update_viscous(ElasticPoint<L, D>& p, L dt) const {
    const Lame<L> m = moduli.as<L>();
    const Svd<L, D> f = svd_any_order(p.F_E);
    const Stretches<L, D> trial(f.s);
    const UnimodularB<L, D> b(trial.s);
    const L kept = L(1) / (L(1) + m.mu * b.mean * dt * L(1 / viscosity));
    const Vector<L, D> s = b.shortened(kept, true);
    // Rotations of the fluid are forgotten too: F_E = V, symmetric.
    p.F_E = compose(f.U, s, f.U);
    return {compose(f.U, Energy::kirchhoff(s, m), f.U), Energy::wave_modulus(s, m),
            Energy::density(trial.s, m) - Energy::density(s, m),
            max(Energy::capped(trial.s), select(trial.mended, L(1), L(0)))};
  }
};

}  // namespace firn
