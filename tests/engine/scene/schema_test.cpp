#include "engine/scene/schema.h"

#include <set>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/scene/example.h"
#include "engine/scene/shape_types.h"
#include "materials/model_info.h"
#include "materials/presets.h"
#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {
namespace {

// The example with the lines that start with '#' and no blank made live, except alternatives inside a live
// table.
std::string with_disabled_blocks() {
  std::string out, line;
  bool in_block = false;
  for (char c : example_scene()) {
    line += c;
    if (c != '\n') continue;
    in_block = line.rfind("#[", 0) == 0 || (in_block && line.rfind("#", 0) == 0);
    out += in_block ? line.substr(1) : line;
    line.clear();
  }
  return out + line;
}

// Every key below the schema's "properties".
void collect_keys(const nlohmann::json& node, std::set<std::string>& keys) {
  if (!node.is_structured()) return;
  if (node.is_object() && node.contains("properties") && node.contains("type")) {
    for (const auto& [key, value] : node["properties"].items()) keys.insert(key);
  }
  for (const auto& child : node) collect_keys(child, keys);
}

TEST_CASE("the example scene is read as it stands") {
  const SceneDescription d = read(example_scene());
  CHECK(d.bodies.size() == 2);
  CHECK(d.colliders.size() == 2);
  CHECK(d.domain);
  CHECK(d.gravity == Vec3(0, -9.81, 0));
}

TEST_CASE("the example scene is read with its alternatives made live, one body a model and a preset") {
  const SceneDescription d = read(with_disabled_blocks());
  CHECK(d.materials.size() == models().size() + 1);
  CHECK(d.bodies.size() == 2 + models().size() + 3);
}

TEST_CASE("the example scene shows every key that the schema has") {
  const std::string scene = with_disabled_blocks();
  const auto schema = nlohmann::json::parse(scene_schema());
  std::set<std::string> keys;
  collect_keys(schema, keys);
  CHECK(keys.size() > 50);
  for (const std::string& key : keys) {
    CAPTURE(key);
    const bool line = scene.find("\n" + key + " = ") != std::string::npos;
    const bool disabled = scene.find("\n#" + key + " = ") != std::string::npos;
    const bool table = scene.find("[" + key + "]") != std::string::npos ||
                       scene.find("." + key + "]") != std::string::npos ||
                       scene.find("[" + key + ".") != std::string::npos;
    CHECK((line || disabled || table));
  }
  for (const ShapeType& type : kShapeTypes) {
    CAPTURE(type.word);
    CHECK(scene.find("type = \"" + std::string(type.word) + "\"") != std::string::npos);
  }
}

TEST_CASE("the schema has a branch for every model with its parameters, limits and defaults") {
  const auto schema = nlohmann::json::parse(scene_schema());
  CHECK(schema["$schema"] == "https://json-schema.org/draft/2020-12/schema");
  const auto& branches = schema["properties"]["materials"]["additionalProperties"]["oneOf"];
  REQUIRE(branches.size() == models().size() + presets().size());
  for (std::size_t i = 0; i < models().size(); ++i) {
    const ModelInfo& model = models()[i];
    const auto& properties = branches[i]["properties"];
    CHECK(properties["model"]["const"] == model.name);
    CHECK(properties.size() == 1 + model.parameters.size());
    CHECK(branches[i]["additionalProperties"] == false);
    for (const Parameter& p : model.parameters) {
      CAPTURE(model.name, p.name);
      const auto& required = branches[i]["required"];
      const bool is_required =
          std::find(required.begin(), required.end(), std::string(p.name)) != required.end();
      CHECK(is_required == p.required());
      const auto& property = properties[std::string(p.name)];
      if (p.required() || std::isinf(p.default_value)) {
        CHECK_FALSE(property.contains("default"));
      } else if (p.is_switch()) {
        CHECK(property["default"] == (p.default_value == 1));
      } else if (!p.choices.empty()) {
        CHECK(property["default"] == p.choices[static_cast<std::size_t>(p.default_value)]);
        CHECK(property["enum"].size() == p.choices.size());
      } else {
        CHECK(property["default"] == p.default_value);
      }
    }
  }
}

TEST_CASE("the schema says limits and defaults as the reader keeps them") {
  const auto simulation = nlohmann::json::parse(scene_schema())["properties"]["simulation"];
  CHECK(simulation["required"] == nlohmann::json({"cell_size", "duration"}));
  CHECK(simulation["properties"]["cfl"]["exclusiveMinimum"] == 0);
  CHECK(simulation["properties"]["cfl"]["maximum"] == 1);
  CHECK(simulation["properties"]["cfl"]["default"] == 0.4);
  CHECK(simulation["properties"]["transfer"]["default"] == "apic");
  CHECK_FALSE(simulation["properties"]["max_dt"].contains("default"));
}

}  // namespace
}  // namespace firn::test
