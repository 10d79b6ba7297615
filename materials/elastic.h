// A purely elastic material: an energy and two moduli. No state beside F_E, nothing to project.
#pragma once

#include "engine/math/svd.h"
#include "materials/near_rest.h"

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
  ElasticPoint<L, D> at_rest() const {
    return {Matrix<L, D>::identity()};
  }

  template <class L, int D>
  Response<L, D> update(ElasticPoint<L, D>& p, L) const {
    const Lame<L> m = moduli.as<L>();
    if constexpr (DirectEnergy<Energy>) {
      const auto direct = Energy::direct_response(p.F_E, m);
      return {direct.tau, direct.wave_modulus, L(0), direct.capped};
    } else if constexpr (kHasNearRest<Energy, L, D>) {
      const NearRotation<L> near(p.F_E);
      const LaneMask<L> quick = near.valid();
      if (!any(quick)) return general_update(p);
      const Response<L, D> out = response_near_rest<Energy>(p.F_E, near, m);
      return any(!quick) ? chosen(quick, out, general_update(p)) : out;
    } else {
      return general_update(p);
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

  /// `update` by singular values, wherever the point is.
  template <class L, int D>
  Response<L, D> general_update(ElasticPoint<L, D>& p) const {
    const Lame<L> m = moduli.as<L>();
    const Svd<L, D> f = svd_any_order(p.F_E);
    return {compose(f.U, Energy::kirchhoff(f.s, m), f.U), Energy::wave_modulus(f.s, m), L(0),
            Energy::capped(f.s)};
  }

  /// The moduli this point has now.
  template <class L, int D>
  Lame<L> current_moduli(const ElasticPoint<L, D>&) const {
    return moduli.as<L>();
  }
};

}  // namespace firn
