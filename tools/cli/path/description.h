// A strain path as its file has it: a material and the legs a specimen of it is led along, one lab test each.
//
// Axis y is the specimen's axis, x and z its sides; the shear moves what is above y along x:
//
//   F = S(gamma) diag(exp e_x, exp e_y, exp e_z),   S = 1 but S_xy = gamma
//
// Strains are logarithmic, positive in extension. Pressures are positive in compression, stresses in tension,
// both Cauchy's.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/description.h"
#include "engine/scene/field.h"

namespace firn {

enum class LabTest { uniaxial, triaxial, oedometer, simple_shear, isotropic, free };

inline constexpr std::array<Choice<LabTest>, 6> kLabTests = {{
    {"uniaxial", LabTest::uniaxial, "the axis is strained, the sides carry nothing"},
    {"triaxial", LabTest::triaxial, "the axis is strained, the sides keep their pressure"},
    {"oedometer", LabTest::oedometer, "the axis is strained, the sides stay where they are"},
    {"simple_shear", LabTest::simple_shear, "sheared, with the height or the normal pressure kept"},
    {"isotropic", LabTest::isotropic, "all faces come to a pressure"},
    {"free", LabTest::free, "strains along every axis"},
}};

struct LegDescription {
  SourceMark mark;
  LabTest test = LabTest::uniaxial;
  double time = 1;  // s
  int steps = 100;
  std::optional<double> strain, pressure, lateral_pressure, normal_pressure, until_stress;
  std::optional<int> cycles;
  Vec3 strains = Vec3::Zero();
  double shear = 0;
};

struct PathDescription {
  std::filesystem::path file;
  std::string title, description;
  MaterialDescription material;
  std::vector<LegDescription> legs;
};

/// Steps of the leg from its first row to its last.
inline std::int64_t all_steps(const LegDescription& leg) {
  return std::int64_t{leg.steps} * (leg.cycles ? 4 * *leg.cycles : 1);
}

}  // namespace firn
