// Metals and putties that yield at a shear stress: von Mises' surface with each of its hardenings and rates.
// The parts' headers have the formulas.
#pragma once

#include "materials/describe.h"
#include "materials/flow_plastic.h"
#include "materials/yields/von_mises.h"

namespace firn {

namespace von_mises_detail {

template <class Flow>
using Law = FlowPlastic<StvkHenckyEnergy, Flow>;

constexpr Parameter sigma_y{"sigma_y", "Pa", "yield stress in a uniaxial pull", kRequired, 0, 1e15};
constexpr Parameter H{
    "H", "Pa",  "yield stress gained per plastic strain; 0: perfect plasticity, < 0: softening",
    0,   -1e15, 1e15};

}  // namespace von_mises_detail

struct VonMisesLinear : von_mises_detail::Law<VonMises<LinearHardening>> {
  static constexpr std::string_view name = "von_mises";
  static constexpr Parameter parameters[] = {density_parameter(), youngs_modulus_parameter(),
                                             poissons_ratio_parameter(), von_mises_detail::sigma_y,
                                             von_mises_detail::H};

  static ModelInfo info() {
    return describe<VonMisesLinear>("metal that yields at a shear stress, perfect or with linear hardening",
                                    "Simo & Hughes 1998, in logarithmic strain (Simo 1992)");
  }
  static VonMisesLinear make(const ParameterValues& v) {
    return {{v.at("density"), moduli_of(v), {{v.at("sigma_y"), v.at("H")}, {}}}};
  }
};

struct VonMisesVoce : von_mises_detail::Law<VonMises<VoceHardening>> {
  static constexpr std::string_view name = "von_mises_voce";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      von_mises_detail::sigma_y,
      von_mises_detail::H,
      {"saturation", "Pa", "Q: yield stress gained in the end", kRequired, 0, 1e15},
      {"exponent", "-", "b: it is gained over plastic strains of 1/b", kRequired, 0, 1e6, true}};

  static ModelInfo info() {
    return describe<VonMisesVoce>("metal whose hardening saturates", "Voce 1948; Simo & Hughes 1998");
  }
  static VonMisesVoce make(const ParameterValues& v) {
    return {{v.at("density"),
             moduli_of(v),
             {{v.at("sigma_y"), v.at("H"), v.at("saturation"), v.at("exponent")}, {}}}};
  }
};

/// With defaults for OFHC copper (Johnson & Cook 1983, table 1).
struct VonMisesJohnsonCook : von_mises_detail::Law<VonMises<PowerHardening, JohnsonCookRate>> {
  static constexpr std::string_view name = "johnson_cook_1983";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      {"A", "Pa", "yield stress at rate_0 before any plastic strain", 90e6, 0, 1e15},
      {"B", "Pa", "hardening: B alpha^n is added", 292e6, 0, 1e15},
      {"n", "-", "hardening exponent", 0.31, 0, 2, true},
      {"C", "-", "rate: the stress grows by 1 + C ln(rate / rate_0)", 0.025, 0, 10},
      {"rate_0", "1/s", "rate of plastic strain from which rates count", 1, 0, 1e9, true}};

  static ModelInfo info() {
    return describe<VonMisesJohnsonCook>("metal under impact, without temperature", "Johnson & Cook 1983");
  }
  static VonMisesJohnsonCook make(const ParameterValues& v) {
    return {
        {v.at("density"), moduli_of(v), {{v.at("A"), v.at("B"), v.at("n")}, {v.at("C"), v.at("rate_0")}}}};
  }
};

struct VonMisesPerzyna : von_mises_detail::Law<VonMises<LinearHardening, PerzynaRate>> {
  static constexpr std::string_view name = "von_mises_perzyna";
  static constexpr Parameter parameters[] = {
      density_parameter(),
      youngs_modulus_parameter(),
      poissons_ratio_parameter(),
      von_mises_detail::sigma_y,
      von_mises_detail::H,
      {"eta", "Pa s", "stress above the yield stress per rate of plastic strain", kRequired, 0, 1e15, true}};

  static ModelInfo info() {
    return describe<VonMisesPerzyna>("metal or putty that yields with a delay", "Perzyna 1966");
  }
  static VonMisesPerzyna make(const ParameterValues& v) {
    return {{v.at("density"), moduli_of(v), {{v.at("sigma_y"), v.at("H")}, {v.at("eta")}}}};
  }
};

}  // namespace firn
