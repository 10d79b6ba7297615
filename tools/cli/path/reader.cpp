#include "tools/cli/path/reader.h"

#include "engine/scene/overrides.h"
#include "engine/scene/scene_text.h"
#include "engine/scene/table_reader.h"
#include "tools/cli/path/checks.h"
#include "tools/cli/path/fields.h"

namespace firn {

PathDescription read_path(const std::filesystem::path& file, std::span<const std::string> overrides) {
  Report report(shown_path(file));
  PathDescription out;
  out.file = file;
  if (auto table = parse_toml(read_scene_file(file), report.file(), report)) {
    for (const std::string& text : overrides) apply_override(text, *table, report);
    TableReader::Context context{report, std::nullopt, false};
    read_all(context, *table, "", out);
  }
  report.throw_if_any();
  // A point has no mass: any density does.
  out.material.parameters.try_emplace("density", MaterialDescription::Value{1.0, {}});
  return out;
}

std::string example_path() {
  return R"toml(# A strain path: lab tests of one specimen. Run it with firn element FILE --out FILE.csv.
# Axis y is the specimen's axis, x and z its sides. Strains are logarithmic, positive in extension; pressures
# are positive in compression, stresses in tension, both Cauchy's (force over present area).
title = "Sand, consolidated and compressed"

[material]                      # as in a scene; firn materials lists them. density may be left out
model = "sand_klar_2016"
youngs_modulus = 5e7            # Pa
h0 = 33                         # degrees

[[legs]]
test = "isotropic"              # all faces come to a pressure
pressure = 1e5                  # Pa
steps = 50                      # 100 if left out

[[legs]]
test = "triaxial"               # the axis is strained, the sides keep their pressure
strain = -0.05                  # added over the leg; negative compresses
time = 60                       # s; 1 if left out. Counts for models with a rate
steps = 200
lateral_pressure = 1e5          # Pa; if left out what the sides carry is kept
#until_stress = -2.5e5          # Pa: the leg ends where the axial (in simple_shear the shear) stress gets there

# The other tests:
#[[legs]]
#test = "uniaxial"              # the sides carry nothing
#strain = 0.01
#cycles = 3                     # to strain, to -strain and back, three times; time and steps are of a quarter
#[[legs]]
#test = "oedometer"             # the sides stay where they are
#strain = -0.02
#until_stress = -1e5
#[[legs]]
#test = "simple_shear"          # x = gamma y
#strain = 0.2                   # gamma
#normal_pressure = 1e5          # kept on the sheared face; if left out its height is kept
#[[legs]]
#test = "free"                  # strains along x, y and z, and gamma
#strains = [0.01, -0.02, 0.01]
#shear = 0
)toml";
}

}  // namespace firn
