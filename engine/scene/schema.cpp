#include "engine/scene/schema.h"

#include <algorithm>

#include "engine/scene/attributes.h"
#include "engine/scene/schema_writer.h"
#include "engine/scene/shape_types.h"
#include "materials/model_info.h"
#include "materials/presets.h"

namespace firn {

void SchemaWriter::attributes(const Key& key, const std::vector<Name>&) {
  Json words = Json::array();
  for (const Attribute& attribute : kAttributes) {
    words.push_back({{"const", attribute.name}, {"description", attribute.meaning}});
  }
  add(key, {{"type", "array"}, {"items", {{"oneOf", words}}}, {"uniqueItems", true}});
}

void SchemaWriter::model(const Key& key, const MaterialDescription&) {
  for (const ModelInfo& model : models()) {
    SchemaWriter& branch = branches_.emplace_back();
    branch.add({key.name, key.need, model.title}, {{"const", model.name}});
    for (const Parameter& p : model.parameters) {
      branch.parameter(p, p.default_value);
    }
  }
  for (const Preset& preset : presets()) {
    SchemaWriter& branch = branches_.emplace_back();
    branch.add({kPresetKey, Need::required, preset.look}, {{"const", preset.name}});
    for (const Parameter& p : find_model(preset.model)->parameters) {
      const auto found = std::find_if(preset.values.begin(), preset.values.end(),
                                      [&](const auto& value) { return value.first == p.name; });
      branch.parameter(p, found == preset.values.end() ? p.default_value : found->second);
    }
  }
}

void SchemaWriter::parameter(const Parameter& p, double value) {
  const Key key = {p.name, std::isnan(value) ? Need::required : Need::optional, p.meaning, p.unit};
  if (p.choices.empty()) return real(key, value, Range::of(p));
  const auto chosen = static_cast<std::size_t>(value);
  if (p.is_switch()) return add_value(key, {{"type", "boolean"}}, chosen == 1);
  add_value(key, {{"enum", p.choices}}, std::string(p.choices[chosen]));
}

void SchemaWriter::kind(const Key& key, const ShapeDescription::Kind&) {
  for (const ShapeType& type : kShapeTypes) {
    SchemaWriter& branch = branches_.emplace_back();
    branch.add({key.name, key.need, type.meaning}, {{"const", type.word}});
    ShapeDescription::Kind kind = type.make();
    std::visit([&](auto& k) { fields(branch, k); }, kind);
  }
}

Json SchemaWriter::finish() const {
  if (!branches_.empty()) {
    Json alternatives = Json::array();
    for (SchemaWriter branch : branches_) {
      branch.properties_.update(properties_);
      branch.required_.insert(branch.required_.end(), required_.begin(), required_.end());
      alternatives.push_back(branch.finish());
    }
    return {{"oneOf", alternatives}};
  }
  Json schema = {{"type", "object"}, {"properties", properties_}, {"additionalProperties", false}};
  if (!required_.empty()) schema["required"] = required_;
  return schema;
}

std::string scene_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Firn scene"}};
  schema.update(SchemaWriter::object<SceneDescription>());
  schema["$defs"]["shape"] = SchemaWriter::object<ShapeDescription>();
  return schema.dump(2) + "\n";
}

}  // namespace firn
