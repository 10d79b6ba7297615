// The point attributes a scene may ask for beside P, v, id and pscale, which every frame holds.
#pragma once

#include <array>
#include <string_view>

namespace firn {

struct Attribute {
  std::string_view name;
  int components;  // in every dimension: a plane scene is written with the entries of the third axis at rest
  std::string_view meaning;
};

inline constexpr std::array<Attribute, 11> kAttributes = {{
    {"F_E", 9, "elastic deformation gradient"},
    {"F_P", 9, "plastic deformation gradient"},
    {"Jp", 1, "det F_P: volume change that stays when the load goes"},
    {"alpha", 1, "what the material hardens with: plastic strain of metals, q of sand, volume of Cam-clay"},
    {"density", 1, "mass over present volume, kg/m^3"},
    {"stress", 9, "Cauchy stress, Pa, positive in tension"},
    {"pressure", 1, "mean of the Cauchy stress along the scene's axes, Pa, positive in compression"},
    {"material", 1, "number of the material, from 0 in the order of the scene"},
    {"mass", 1, "kg"},
    {"volume", 1, "present volume, m^3"},
    {"C", 9, "affine part of the velocity (APIC), 1/s"},
}};

inline constexpr std::array<std::string_view, 4> kAlwaysWritten = {"P", "v", "id", "pscale"};

}  // namespace firn
