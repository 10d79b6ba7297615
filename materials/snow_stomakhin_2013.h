// Snow (Stomakhin, Schroeder, Chai, Teran, Selle 2013, "A material point method for snow simulation"): fixed
// corotated elasticity of F_E, its singular values kept in [1 - theta_c, 1 + theta_s], moduli scaled by
// exp(xi (1 - J_P)) with J_P = det F_P. The parts' headers have the formulas. Defaults are the paper's.
//
// Ours beside the paper: the factor has a cap. 300 is reached at J_P = 0.43 with xi = 10, where snow of 400
// kg/m^3 has the density of ice (917) and cannot be compacted further; the speed of sound is then 17 times
// that at rest, and so many times smaller the time step. A model for visual effects, without rate dependence,
// sintering or melting.
#pragma once

#include <cmath>

#include "materials/describe.h"
#include "materials/elasto_plastic.h"
#include "materials/energies/fixed_corotated.h"
#include "materials/hardening/exponential_compaction.h"
#include "materials/yields/singular_value_clamp.h"

namespace firn {

struct SnowStomakhin2013 : ElastoPlastic<FixedCorotatedEnergy, SingularValueClamp, ExponentialCompaction> {
  static constexpr std::string_view name = "snow_stomakhin_2013";
  static constexpr Parameter parameters[] = {
      density_parameter(400),
      youngs_modulus_parameter(1.4e5),
      poissons_ratio_parameter(0.2),
      {"theta_c", "-", "critical compression: elastic stretches stay above 1 - theta_c", 2.5e-2, 0, 1, false,
       true},
      {"theta_s", "-", "critical stretch: elastic stretches stay below 1 + theta_s", 7.5e-3, 0, 10},
      {"xi", "-", "hardening: the moduli grow by exp(xi (1 - J_P)) with plastic compaction", 10, 0, 1000},
      {"hardening_cap", "-", "largest factor on the moduli; inf: none", 300, 1, kInfinity},
  };

  static ModelInfo info() {
    return describe<SnowStomakhin2013>("snow that compacts, hardens, fractures and rolls into balls",
                                       "Stomakhin, Schroeder, Chai, Teran, Selle 2013");
  }
  static SnowStomakhin2013 make(const ParameterValues& v) {
    return {{v.at("density"),
             moduli_of(v),
             {v.at("theta_c"), v.at("theta_s")},
             {v.at("xi"), std::log(v.at("hardening_cap"))}}};
  }
};

}  // namespace firn
