// An elastic solid in logarithmic strain: materials/energies/stvk_hencky.h has the formulas and where they
// stop being valid.
#pragma once

#include "materials/describe.h"
#include "materials/elastic.h"
#include "materials/energies/stvk_hencky.h"

namespace firn {

struct StvkHencky : Elastic<StvkHenckyEnergy> {
  static constexpr std::string_view name = "stvk_hencky";
  static constexpr Parameter parameters[] = {density_parameter(), youngs_modulus_parameter(),
                                             poissons_ratio_parameter()};

  static ModelInfo info() {
    return describe<StvkHencky>("elastic solid, quadratic in the logarithmic strain",
                                "as in Klar et al. 2016");
  }
  static StvkHencky make(const ParameterValues& v) { return {{v.at("density"), moduli_of(v)}}; }
};

}  // namespace firn
