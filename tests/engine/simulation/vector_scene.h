// What the vectorised path is tried on, and how it is asked for.
#pragma once

#include <cstdlib>
#include <map>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "materials/registry.h"
#include "tests/support/simulated.h"

namespace firn::test {

// Two bodies of two materials that hit each other, a ground and a moving collider, walls, gravity, spin:
// everything a step can do, in blocks of negative and positive coordinates. Of softer material than its own,
// when said: then steps are long and particles soon need sorting.
inline std::string collision_scene(int dimension, double youngs_modulus = 0) {
  std::string text = R"(
[simulation]
cell_size = 0.05
duration = 1
[gravity]
acceleration = [0.5, -9.81, 0]
[materials.snow]
model = "snow_stomakhin_2013"
[materials.rubber]
model = "neo_hookean"
density = 300
youngs_modulus = 2e5
poissons_ratio = 0.3
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [-0.12, 0.2, 0], radius = 0.19 }
velocity = [3, -5, 0]
angular_velocity = [0, 0, 300]
[[bodies]]
name = "block"
material = "rubber"
shape = { type = "box", min = [0.08, 0.05, 0], max = [0.4, 0.3, 0] }
velocity = [-3, 0, 0]
[[colliders]]
name = "ground"
shape = { type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }
friction = 0.4
[[colliders]]
name = "paddle"
shape = { type = "sphere", center = [0, 0, 0], radius = 0.1 }
contact = "slip"
keyframes = [ { time = 0, position = [-0.4, 0.2, 0] }, { time = 1, position = [3, 0.2, 0] } ]
[domain]
min = [-0.6, -1, 0]
max = [0.6, 1, 0]
[output]
attributes = ["F_E", "stress", "Jp"]
)";
  if (dimension == 3)
    for (const auto& [from, to] :
         {std::pair("center = [-0.12, 0.2, 0]", "center = [-0.12, 0.2, 0.02]"),
          std::pair("[3, -5, 0]", "[3, -5, 0.3]"), std::pair("[0, 0, 300]", "[40, 20, 300]"),
          std::pair("0.05, 0]", "0.05, -0.15]"), std::pair("0.3, 0] }", "0.3, 0.17] }"),
          std::pair("-1, 0]", "-1, -0.4]"), std::pair("1, 0]\n[output", "1, 0.4]\n[output")})
      text.replace(text.find(from), std::string(from).size(), to);
  if (youngs_modulus > 0) {
    const std::string soft = "youngs_modulus = " + std::to_string(youngs_modulus);
    text.replace(text.find("youngs_modulus = 2e5"), 20, soft);
    text.insert(text.find("[materials.rubber]"), soft + "\n");
  }
  return text;
}

/// The same with another material in place of the snow, soft enough to yield as the bodies hit each other.
/// But Cam-clay only sheared, not crushed: its hardening jumps between the two, so that a rounding decides.
inline std::string with_material(std::string scene, const ModelInfo& model) {
  const std::map<std::string_view, double> soft = {{"density", 400},
                                                   {"youngs_modulus", 1.4e5},
                                                   {"poissons_ratio", 0.2},
                                                   {"sigma_y", 2e3},
                                                   {"eta", 20},
                                                   {"A", 2e3},
                                                   {"B", 1e3},
                                                   {"saturation", 1e3},
                                                   {"exponent", 20},
                                                   {"M", 1.5},
                                                   {"beta", 0.5},
                                                   {"alpha_0", -0.05},
                                                   {"xi", 3},
                                                   {"P_Y", 2e3},
                                                   {"nu_flow", 0.1},
                                                   {"tensile_strength", 1e3},
                                                   {"viscosity", 5}};
  std::string text = "model = \"" + std::string(model.name) + "\"\n";
  for (const Parameter& p : model.parameters)
    if (const auto value = soft.find(p.name); value != soft.end())
      text += std::string(p.name) + " = " + std::to_string(value->second) + "\n";
  const std::string snow = "model = \"snow_stomakhin_2013\"\n";
  scene.replace(scene.find(snow), snow.size(), text);
  // Without a plastic material there is no Jp.
  return scene.replace(scene.find(", \"Jp\""), 6, "");
}

inline constexpr int kModels = static_cast<int>(std::variant_size_v<Material>);

inline double most(const std::vector<float>& a, const std::vector<float>& b) {
  double out = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    out = std::max(out, std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k])));
  return out;
}

inline std::vector<std::string> settings(const std::string& precision, const std::string& transfer,
                                         int dimension, const std::string& path) {
  return {"simulation.precision=\"" + precision + '"', "simulation.transfer=\"" + transfer + '"',
          "simulation.dimension=" + std::to_string(dimension), "simulation.path=\"" + path + '"'};
}

/// With the kernels of one instruction set; null, with a warning, on a processor that lacks it.
inline std::unique_ptr<Simulated> on_isa(const std::string& isa, const std::string& scene,
                                         const std::vector<std::string>& overrides,
                                         const std::function<void(std::vector<Seeds>&)>& change = {}) {
  setenv("FIRN_ISA", isa.c_str(), 1);
  std::unique_ptr<Simulated> out;
  try {
    out = std::make_unique<Simulated>(scene, overrides, FIRN_TEST_DATA, change);
  } catch (const Error& error) {
    unsetenv("FIRN_ISA");
    if (error.code() != ExitCode::environment) throw;
    WARN("no " << isa << " here");  // the other sets are tried
    return nullptr;
  }
  unsetenv("FIRN_ISA");
  REQUIRE(out->plan.path.isa);
  return out;
}

}  // namespace firn::test
