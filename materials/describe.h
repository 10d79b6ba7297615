// The pieces models describe themselves with.
#pragma once

#include "materials/elastic_moduli.h"
#include "materials/model_info.h"
#include "materials/parameter.h"

namespace firn {

inline constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The upper limits are far beyond any matter; they keep every product with them finite in float.
constexpr Parameter density_parameter(double default_value = kRequired) {
  return {"density", "kg/m^3", "mass per volume at rest", default_value, 0, 1e9, true};
}
constexpr Parameter youngs_modulus_parameter(double default_value = kRequired) {
  return {"youngs_modulus", "Pa", "E: stiffness in a uniaxial pull", default_value, 0, 1e15, true};
}
constexpr Parameter poissons_ratio_parameter(double default_value = kRequired) {
  return {
      "poissons_ratio", "-", "nu: lateral contraction over extension", default_value, -1, 0.5, true, true};
}

/// Of those two parameters.
inline Lame<double> moduli_of(const ParameterValues& v) {
  return lame(v.at("youngs_modulus"), v.at("poissons_ratio"));
}

/// What a return map in shear may keep.
inline constexpr std::string_view kVolumeChoices[] = {"preserve", "published"};

/// What makes a model's flow a matter of time.
template <class Model>
constexpr std::string_view rate_name() {
  if constexpr (requires { Model::Flow::rate_name; }) return Model::Flow::rate_name;
  return "none";
}

/// The description of `Model`, from what its type says and the words given here.
template <class Model>
ModelInfo describe(std::string_view title, std::string_view source) {
  return {Model::name,
          title,
          source,
          Model::Energy::name,
          Model::yield_name,
          Model::hardening_name,
          rate_name<Model>(),
          Model::decomposition,
          Model::template Point<double, 3>::columns,
          Model::parameters};
}

}  // namespace firn
