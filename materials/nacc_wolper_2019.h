// Matter that hardens as it is compacted and cracks as it is torn (Wolper, Fang, Li, Lu, Gao, Jiang 2019,
// "CD-MPM", non-associated Cam-clay without its fracture; Gaume, Gast, Teran, van Herwijnen, Jiang 2018 for
// snow): materials/yields/cohesive_cam_clay.h.
#pragma once

#include "materials/describe.h"
#include "materials/flow_plastic.h"
#include "materials/yields/cohesive_cam_clay.h"

namespace firn {

struct NaccWolper2019 : FlowPlastic<IsochoricNeoHookeanEnergy, CohesiveCamClay> {
  static constexpr std::string_view name = "nacc_wolper_2019";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      {"M", "-", "slope of the critical state line: shear strength over pressure", kRequired, 0, 100, true},
      {"beta", "-", "cohesion: tensile over compressive strength", kRequired, 0, 100},
      {"xi", "-", "hardening: how fast the strength grows with compaction", kRequired, 0, 1000},
      {"alpha_0", "-", "logarithmic plastic volume at the start; < 0: consolidated", -0.01, -100, 100},
      {"volume", "-", "what a step that yields in shear keeps: J, or tr b as published", 0, 0, 1, false,
       false, kVolumeChoices}};

  static ModelInfo info() {
    return describe<NaccWolper2019>("snow, mud or soil that hardens when compacted and tears apart",
                                    "Gaume et al. 2018; Wolper et al. 2019");
  }
  static NaccWolper2019 make(const ParameterValues& v) {
    return {{v.at("density"),
             moduli_of(v),
             {v.at("M"), v.at("beta"), v.at("xi"), v.at("alpha_0"), v.at("volume") == 0}}};
  }
};

}  // namespace firn
