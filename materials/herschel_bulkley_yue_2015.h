// Foams, pastes and thick fluids (Yue, Smith, Batty, Zheng, Grinspun 2015, "Continuum foam"; Ram et al.
// 2015): materials/yields/herschel_bulkley.h.
#pragma once

#include "materials/describe.h"
#include "materials/flow_plastic.h"
#include "materials/yields/herschel_bulkley.h"

namespace firn {

struct HerschelBulkleyYue2015 : FlowPlastic<IsochoricNeoHookeanEnergy, HerschelBulkley> {
  static constexpr std::string_view name = "herschel_bulkley_yue_2015";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      {"sigma_y", "Pa", "yield stress in a uniaxial pull; 0: flows under any load", kRequired, 0, 1e15},
      {"eta", "Pa s^h", "shear stress above it per rate of flow to the power h", kRequired, 0, 1e15, true},
      {"h", "-", "1: Bingham's fluid; below, it thins as it flows", 1, 0.05, 10},
      {"volume", "-", "what a step that flows keeps: J, or tr b as published", 0, 0, 1, false, false,
       kVolumeChoices}};

  static ModelInfo info() {
    return describe<HerschelBulkleyYue2015>("foam, paste or cream: solid at rest, flows under load",
                                            "Yue et al. 2015; Ram et al. 2015");
  }
  static HerschelBulkleyYue2015 make(const ParameterValues& v) {
    return {{v.at("density"), moduli_of(v), {v.at("sigma_y"), v.at("eta"), v.at("h"), v.at("volume") == 0}}};
  }
};

}  // namespace firn
