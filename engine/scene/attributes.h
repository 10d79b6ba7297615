// The point attributes a scene may ask for beside P, v, id and pscale, which every frame holds.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "engine/particles/columns.h"

namespace firn {

struct Attribute {
  std::string_view name;
  int components;  // in every dimension: a plane scene is written with the entries of the third axis at rest
  std::string_view meaning;
  std::optional<Column> needs{};  // of some particle
  std::string_view why_absent{};  // where none has it
};

inline constexpr std::string_view kNotPlastic = "no material of this scene is plastic";

inline constexpr std::array<Attribute, 11> kAttributes = {{
    {"F_E", 9, "elastic deformation gradient"},
    {"F_P", 9, "plastic deformation gradient", Column::plastic_deformation, kNotPlastic},
    {"Jp", 1, "det F_P: volume change that stays when the load goes", Column::plastic_deformation,
     kNotPlastic},
    {"alpha", 1, "what the material hardens with: plastic strain of metals, q of sand, volume of Cam-clay",
     Column::hardening, "no material of this scene stores what it hardens with"},
    {"density", 1, "mass over present volume, kg/m^3"},
    {"stress", 9, "Cauchy stress, Pa, positive in tension"},
    {"pressure", 1, "mean of the Cauchy stress along the scene's axes, Pa, positive in compression"},
    {"material", 1, "number of the material, from 0 in the order of the scene"},
    {"mass", 1, "kg"},
    {"volume", 1, "present volume, m^3"},
    {"C", 9, "affine part of the velocity (APIC), 1/s", Column::affine,
     "only simulation.transfer = \"apic\" and \"mls\" store it"},
}};

inline constexpr std::array<std::string_view, 4> kAlwaysWritten = {"P", "v", "id", "pscale"};

}  // namespace firn
