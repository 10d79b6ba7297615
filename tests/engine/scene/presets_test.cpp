// Materials that start from a preset.
#include "materials/presets.h"

#include <catch2/catch.hpp>

#include "materials/registry.h"
#include "tests/engine/scene/scene_text_support.h"

using namespace firn;
using namespace firn::test;

TEST_CASE("every preset gives its model all it needs, within its ranges") {
  CHECK(presets().size() == 14);
  for (const Preset& preset : presets()) {
    CAPTURE(preset.name);
    CHECK(find_preset(preset.name) == &preset);
    CHECK(find_model(preset.name) == nullptr);
    CHECK_FALSE(preset.look.empty());
    CHECK_FALSE(preset.source.empty());
    const ModelInfo* model = find_model(preset.model);
    REQUIRE(model);
    std::size_t known = 0;
    ParameterValues values;
    for (const Parameter& p : model->parameters) {
      values[std::string(p.name)] = p.default_value;
      for (const auto& [name, value] : preset.values) {
        if (name != p.name) continue;
        CHECK(p.allows(value));
        values[std::string(p.name)] = value;
        ++known;
      }
      CHECK_FALSE(std::isnan(values[std::string(p.name)]));
    }
    CHECK(known == preset.values.size());
    make_material(model->name, values);
  }
}

namespace {

const std::string kScene = R"([simulation]
cell_size = 0.1
duration = 1
[materials.heap]
preset = "wet_sand"
density = 1900
volume_correction = false
[[bodies]]
name = "a"
material = "heap"
shape = { type = "sphere", center = [0, 0, 0], radius = 0.5 }
)";

std::string error_with(const std::string& line) {
  std::string text = kScene;
  text.replace(text.find("density = 1900"), 14, line);
  try {
    read_scene_text(text, "scene.toml");
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a preset's keys may be set otherwise") {
  const MaterialDescription m = read_scene_text(kScene, "scene.toml").materials.at(0);
  CHECK(m.model.text == "sand_klar_2016");
  CHECK(std::get<double>(m.parameters.at("density").value) == 1900);
  CHECK(std::get<double>(m.parameters.at("tensile_strength").value) == 1000);
  CHECK(std::get<double>(m.parameters.at("volume_correction").value) == 0);
}

TEST_CASE("what is wrong about a preset is said") {
  CHECK(error_with("model = \"fluid\"")
            .find("model: stands beside 'preset', which has a model; leave one out") != std::string::npos);
  CHECK(error_with("densty = 1").find("did you mean 'density'?") != std::string::npos);
  CHECK(error_with("tensile_strength = -1")
            .find("found the integer -1; allowed: a number in [0, 1e+12] (Pa)") != std::string::npos);
  std::string text = kScene;
  text.replace(text.find("wet_sand"), 8, "wet_snad");
  CHECK_THROWS_WITH(read_scene_text(text, "scene.toml"), Catch::Contains("did you mean 'wet_sand'?"));
  text = kScene;
  text.replace(text.find("= false"), 7, "= \"no\"");
  CHECK_THROWS_WITH(read_scene_text(text, "scene.toml"), Catch::Contains("allowed: false, true"));
}
