// A robust elastic solid: materials/energies/fixed_corotated.h has the formulas and where they stop being
// valid.
#pragma once

#include "materials/describe.h"
#include "materials/elastic.h"
#include "materials/energies/fixed_corotated.h"

namespace firn {

struct FixedCorotated : Elastic<FixedCorotatedEnergy> {
  static constexpr std::string_view name = "fixed_corotated";
  static constexpr Parameter parameters[] = {density_parameter(), youngs_modulus_parameter(),
                                             poissons_ratio_parameter()};

  static ModelInfo info() {
    return describe<FixedCorotated>("elastic solid, exact for rotations, robust when inverted",
                                    "Stomakhin, Howes, Schroeder, Teran 2012");
  }
  static FixedCorotated make(const ParameterValues& v) { return {{v.at("density"), moduli_of(v)}}; }
};

}  // namespace firn
