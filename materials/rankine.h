// Brittle matter: elastic until a principal stress reaches the tensile strength, which then fades.
// materials/yields/rankine.h.
#pragma once

#include "materials/describe.h"
#include "materials/flow_plastic.h"
#include "materials/yields/rankine.h"

namespace firn {

struct RankineCutOff : FlowPlastic<StvkHenckyEnergy, Rankine> {
  static constexpr std::string_view name = "rankine";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      {"tensile_strength", "Pa", "largest principal tension", kRequired, 0, 1e12},
      {"softening_strain", "-", "opening over which the strength fades by e; inf: it stays", kInfinity, 0,
       kInfinity, true}};

  static ModelInfo info() {
    return describe<RankineCutOff>("brittle: ice, chalk, concrete in tension",
                                   "Rankine's criterion; closest-point return of de Souza Neto et al. 2008");
  }
  static RankineCutOff make(const ParameterValues& v) {
    return {{v.at("density"), moduli_of(v), {v.at("tensile_strength"), v.at("softening_strain")}}};
  }
};

}  // namespace firn
