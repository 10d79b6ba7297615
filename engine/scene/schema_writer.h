// The visitor of fields.h that says what it visits as a JSON Schema.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/scene/fields.h"

namespace firn {

using Json = nlohmann::ordered_json;

class SchemaWriter {
 public:
  /// The schema of a table with the keys of T.
  template <class T>
  static Json object() {
    T defaults = defaults_of<T>();
    SchemaWriter writer;
    fields(writer, defaults);
    return writer.finish();
  }

  template <class T>
  void real(const Key& key, const T& value, const Range& range) {
    Json schema = {{"type", "number"}};
    if (std::isfinite(range.min)) schema[range.min_open ? "exclusiveMinimum" : "minimum"] = range.min;
    if (std::isfinite(range.max)) schema[range.max_open ? "exclusiveMaximum" : "maximum"] = range.max;
    add_value(key, std::move(schema), value);
  }
  template <class T>
  void integer(const Key& key, const T& value, const IntegerRange& range) {
    add_value(key, {{"type", "integer"}, {"minimum", range.min}, {"maximum", range.max}}, value);
  }
  template <class E, std::size_t n>
  void choice(const Key& key, E value, const std::array<Choice<E>, n>& choices) {
    Json words = Json::array();
    std::string_view chosen;
    for (const Choice<E>& c : choices) {
      words.push_back({{"const", c.word}, {"description", c.meaning}});
      if (c.value == value) chosen = c.word;
    }
    add_value(key, {{"oneOf", words}}, std::string(chosen));
  }
  void text(const Key& key, const std::string&) { add(key, {{"type", "string"}}); }
  void name(const Key& key, const Name&) { add(key, {{"type", "string"}}); }
  template <class T>
  void file(const Key& key, const T&) {
    add(key, {{"type", "string"}, {"minLength", 1}});
  }
  void vector(const Key& key, const Vec3& value, Axes = Axes::along) {
    add_value(key, {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}},
              std::array{value[0], value[1], value[2]});
  }
  void quantities(const Key& key, const VectorQuantity& value, std::span<const std::string_view>) {
    Json defaults = Json::array();
    for (const Quantity& q : value) defaults.push_back(q.formula.empty() ? Json(q.number) : Json(q.formula));
    add_value(
        key,
        {{"type", "array"}, {"items", {{"type", {"number", "string"}}}}, {"minItems", 3}, {"maxItems", 3}},
        defaults);
  }
  void attributes(const Key& key, const std::vector<Name>&);
  void model(const Key& key, const MaterialDescription&);
  void kind(const Key& key, const ShapeDescription::Kind&);
  template <class S>
  void shape(const Key& key, const S&) {
    add(key, shape_reference());
  }
  void shapes(const Key& key, const std::vector<ShapeDescription>&) {
    add(key, {{"type", "array"}, {"items", shape_reference()}, {"minItems", 2}});
  }
  void materials(const Key& key, const std::vector<MaterialDescription>&) {
    add(key, {{"type", "object"}, {"additionalProperties", object<MaterialDescription>()}});
  }
  template <class T>
  void section(const Key& key, const T&) {
    add(key, object<T>());
  }
  template <class T>
  void section(const Key& key, const std::optional<T>&) {
    add(key, object<T>());
  }
  template <class T>
  void list(const Key& key, const std::vector<T>&) {
    add(key, {{"type", "array"}, {"items", object<T>()}, {"minItems", key.need == Need::required ? 1 : 0}});
  }

 private:
  void parameter(const Parameter& p, double value);
  // A shape can hold shapes, so that its schema has to go by a name.
  static Json shape_reference() { return {{"$ref", "#/$defs/shape"}}; }

  void add(const Key& key, Json schema) {
    const std::string unit = key.unit == "-" ? "" : fmt::format(" ({})", key.unit);
    schema["description"] = std::string(key.meaning) + unit;
    properties_[std::string(key.name)] = std::move(schema);
    if (key.need == Need::required) required_.push_back(key.name);
  }
  template <class T>
  void add_value(const Key& key, Json schema, const T& value) {
    if (key.need == Need::optional && !is_infinite(value)) schema["default"] = value;
    add(key, std::move(schema));
  }
  // JSON has no infinity: no default, as if there were no limit.
  template <class T>
  static bool is_infinite(const T& value) {
    if constexpr (std::is_floating_point_v<T>) return std::isinf(value);
    return false;
  }
  template <class T>
  void add_value(const Key& key, Json schema, const std::optional<T>&) {
    add(key, std::move(schema));
  }
  Json finish() const;

  Json properties_ = Json::object();
  Json required_ = Json::array();
  std::vector<SchemaWriter> branches_;  // one for each model or type; their keys come beside the common ones
};

}  // namespace firn
