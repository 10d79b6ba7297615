// Sand (Klar, Gast, Pradhana, Fu, Schroeder, Jiang, Teran 2016, "Drucker-Prager elastoplasticity for sand
// animation"), with their constants as defaults: materials/yields/drucker_prager.h has the law and what is
// ours in it.
#pragma once

#include "materials/describe.h"
#include "materials/flow_plastic.h"
#include "materials/yields/drucker_prager.h"

namespace firn {

namespace sand_detail {

template <class Rate>
using Law = FlowPlastic<StvkHenckyEnergy, DruckerPrager<Rate>>;

constexpr Parameter density = density_parameter(2200), youngs = youngs_modulus_parameter(3.537e5),
                    poisson = poissons_ratio_parameter(0.3);
constexpr Parameter h0{"h0", "degrees", "friction angle in the end", 35, 0, 89},
    h1{"h1", "degrees", "friction angle gained per plastic strain, while it lasts", 9, 0, 1000},
    h2{"h2", "-", "the friction angle settles over plastic strains of 1/h2", 0.2, 0, 1000},
    h3{"h3", "degrees", "how much smaller the friction angle is at the start", 10, 0, 89},
    strength{"tensile_strength", "Pa", "tension from all sides that parts the grains; 0: dry", 0, 0, 1e12},
    correction{"volume_correction",
               "-",
               "grains that parted press only where they touch again",
               1,
               0,
               1,
               false,
               false,
               kSwitch};

template <class Rate>
typename sand_detail::Law<Rate> law(const ParameterValues& v, Rate rate) {
  return {v.at("density"),
          moduli_of(v),
          {{v.at("h0"), v.at("h1"), v.at("h2"), v.at("h3")},
           rate,
           v.at("tensile_strength"),
           v.at("volume_correction") != 0}};
}

}  // namespace sand_detail

struct SandKlar2016 : sand_detail::Law<RateIndependent> {
  static constexpr std::string_view name = "sand_klar_2016";
  static constexpr Parameter parameters[] = {
      sand_detail::density, sand_detail::youngs,   sand_detail::poisson,
      sand_detail::h0,      sand_detail::h1,       sand_detail::h2,
      sand_detail::h3,      sand_detail::strength, sand_detail::correction};

  static ModelInfo info() {
    return describe<SandKlar2016>("grains that slide on each other with friction, dry or damp",
                                  "Klar et al. 2016; volume after Tampubolon et al. 2017");
  }
  static SandKlar2016 make(const ParameterValues& v) { return {sand_detail::law(v, RateIndependent{})}; }
};

struct SandPerzyna : sand_detail::Law<PerzynaRate> {
  static constexpr std::string_view name = "sand_perzyna";
  static constexpr Parameter parameters[] = {
      sand_detail::density,
      sand_detail::youngs,
      sand_detail::poisson,
      sand_detail::h0,
      sand_detail::h1,
      sand_detail::h2,
      sand_detail::h3,
      sand_detail::strength,
      sand_detail::correction,
      {"eta", "Pa s", "shear stress above the friction per rate of plastic strain", kRequired, 0, 1e15,
       true}};

  static ModelInfo info() {
    return describe<SandPerzyna>("grains in a thick fluid: friction and a delay",
                                 "Klar et al. 2016 with the overstress of Perzyna 1966");
  }
  static SandPerzyna make(const ParameterValues& v) {
    return {sand_detail::law(v, PerzynaRate{v.at("eta")})};
  }
};

}  // namespace firn
