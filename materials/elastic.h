// A purely elastic material: an energy and two moduli. No state beside F_E, nothing to project.
#pragma once

#include "engine/math/svd.h"
#include "materials/material_point.h"
#include "materials/principal.h"

namespace firn {

template <PrincipalEnergy EnergyPart>
struct Elastic {
  using Energy = EnergyPart;
  template <class L, int D>
  using Point = ElasticPoint<L, D>;
  static constexpr std::string_view yield_name = "none", hardening_name = "none";
  static constexpr std::string_view decomposition = DirectEnergy<Energy> ? "none" : "SVD";

  double density;       // kg/m^3 at rest
  Lame<double> moduli;  // Pa

  template <class L, int D>
  Response<L, D> update(ElasticPoint<L, D>& p, L) const {
    const Lame<L> m = moduli.as<L>();
    if constexpr (DirectEnergy<Energy>) {
      const auto direct = Energy::direct_response(p.F_E, m);
      return {direct.tau, direct.wave_modulus, L(0), direct.capped};
    } else {
      const Svd<L, D> f = svd_any_order(p.F_E);
      return {compose(f.U, Energy::kirchhoff(f.s, m), f.U), Energy::wave_modulus(f.s, m), L(0),
              Energy::capped(f.s)};
    }
  }

  template <class L, int D>
  L energy(const ElasticPoint<L, D>& p) const {
    const Lame<L> m = moduli.as<L>();
    if constexpr (DirectEnergy<Energy>) {
      return Energy::direct_density(p.F_E, m);
    } else {
      return Energy::density(svd_any_order(p.F_E).s, m);
    }
  }

  /// The moduli this point has now.
  template <class L, int D>
  Lame<L> current_moduli(const ElasticPoint<L, D>&) const {
    return moduli.as<L>();
  }
};

}  // namespace firn
