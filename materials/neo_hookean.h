// A rubber-like solid: materials/energies/neo_hookean.h has the formulas and where they stop being valid.
#pragma once

#include "materials/describe.h"
#include "materials/elastic.h"
#include "materials/energies/neo_hookean.h"

namespace firn {

struct NeoHookean : Elastic<NeoHookeanEnergy> {
  static constexpr std::string_view name = "neo_hookean";
  static constexpr Parameter parameters[] = {density_parameter(), youngs_modulus_parameter(),
                                             poissons_ratio_parameter()};

  static ModelInfo info() {
    return describe<NeoHookean>(
        "rubber-like solid with a logarithmic barrier against collapse; needs no decomposition",
        "Bonet and Wood 1997");
  }
  static NeoHookean make(const ParameterValues& v) { return {{v.at("density"), moduli_of(v)}}; }
};

}  // namespace firn
