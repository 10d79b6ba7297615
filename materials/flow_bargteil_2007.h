// Plastic flow (Bargteil, Wojtan, Hodgins, Turk 2007, "A finite element method for animating large
// viscoplastic flow", after Irving, Teran, Fedkiw 2004): materials/yields/bargteil_flow.h, on fixed corotated
// elasticity.
#pragma once

#include "materials/describe.h"
#include "materials/energies/fixed_corotated.h"
#include "materials/flow_plastic.h"
#include "materials/yields/bargteil_flow.h"

namespace firn {

struct FlowBargteil2007 : FlowPlastic<FixedCorotatedEnergy, BargteilFlow<FixedCorotatedEnergy>> {
  static constexpr std::string_view name = "flow_bargteil_2007";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      {"P_Y", "Pa", "stress from which it flows, pressure included", kRequired, 0, 1e15},
      {"nu_flow", "-", "part of the isochoric stretch that is gone after dt_ref under a large stress",
       kRequired, 0, 1, false, true},
      {"K", "Pa", "stress limit gained per flow", 0, 0, 1e15},
      {"dt_ref", "s", "the step that nu_flow is for", 1e-3, 0, 1e6, true}};

  static ModelInfo info() {
    return describe<FlowBargteil2007>("putty that is squeezed and stays so",
                                      "Bargteil et al. 2007; Irving et al. 2004");
  }
  static FlowBargteil2007 make(const ParameterValues& v) {
    return {{v.at("density"), moduli_of(v), {v.at("P_Y"), v.at("nu_flow"), v.at("K"), v.at("dt_ref")}}};
  }
};

}  // namespace firn
