// The keys of fields.h whose values have a form of their own.
#include <fmt/ranges.h>

#include "engine/base/nearest_name.h"
#include "engine/scene/attributes.h"
#include "engine/scene/shape_types.h"
#include "engine/scene/table_reader.h"
#include "materials/model_info.h"
#include "materials/presets.h"

namespace firn {

void TableReader::text(const Key& key, std::string& out) {
  if (auto value = read_text(key, "a text in quotes")) out = std::move(value->text);
}

void TableReader::name(const Key& key, Name& out) {
  if (auto value = read_text(key, "a name in quotes")) out = std::move(*value);
}

const toml::array* TableReader::read_three(const Key& key, std::string_view allowed) {
  const toml::node* node = find(key, allowed);
  if (!node) return nullptr;
  const toml::array* array = node->as_array();
  if (array && array->size() == 3) return array;
  refuse(key.name, *node, allowed);
  return nullptr;
}

/// Whether the scene has that axis, if the component on it is not 0; else that is reported.
bool TableReader::check_axis(const Key& key, const toml::node& node, bool zero, Axes axes, int axis) {
  if (zero || has_axis(axes, axis, context_.dimension.value_or(3))) return true;
  refuse(key.name, node, fmt::format("[{}]", axis),
         found_and_allowed(node, fmt::format("0, for the scene has dimension {}", *context_.dimension)));
  return false;
}

void TableReader::vector(const Key& key, Vec3& out, Axes axes) {
  const std::string unit = key.unit == "-" ? "" : fmt::format(" ({})", key.unit);
  const toml::array* array = read_three(key, "[x, y, z], three numbers" + unit);
  if (!array) return;
  for (int axis = 0; axis < 3; ++axis) {
    const toml::node& number = (*array)[static_cast<std::size_t>(axis)];
    const double value = number.value<double>().value_or(std::numeric_limits<double>::quiet_NaN());
    if (!number.is_number() || !kAnyNumber.allows(value)) {
      refuse(key.name, number, fmt::format("[{}]", axis),
             found_and_allowed(number, allowed_number(kAnyNumber, key.unit)));
    } else if (check_axis(key, number, value == 0, axes, axis)) {
      out[axis] = value;
    }
  }
}

void TableReader::quantities(const Key& key, VectorQuantity& out, std::span<const std::string_view> names) {
  const std::string each = fmt::format("{} or a formula in quotes, of {}",
                                       allowed_number(kAnyNumber, key.unit), fmt::join(names, ", "));
  const toml::array* array = read_three(key, "[x, y, z], each " + each);
  if (!array) return;
  for (int axis = 0; axis < 3; ++axis) {
    const toml::node& node = (*array)[static_cast<std::size_t>(axis)];
    const std::string element = fmt::format("[{}]", axis);
    Quantity& quantity = out[static_cast<std::size_t>(axis)];
    const double value = node.value<double>().value_or(std::numeric_limits<double>::quiet_NaN());
    if (node.is_string()) {
      const std::string& text = node.as_string()->get();
      try {
        const Formula formula(text, names);
        if (check_axis(key, node, false, Axes::along, axis)) quantity.formula = text;
      } catch (const FormulaError& error) {
        refuse(key.name, node, element,
               fmt::format("found '{}': {}; allowed: {}, with {}", printable(text), error.what(), each,
                           formula_words()));
      }
    } else if (!node.is_number() || !kAnyNumber.allows(value)) {
      refuse(key.name, node, element, found_and_allowed(node, each));
    } else if (check_axis(key, node, value == 0, Axes::along, axis)) {
      quantity.number = value;
    }
  }
}

void TableReader::attributes(const Key& key, std::vector<Name>& out) {
  const toml::array* array = read_array(key, "an array of names of attributes", 0);
  if (!array) return;
  std::vector<std::string_view> known;
  for (const Attribute& attribute : kAttributes) known.push_back(attribute.name);
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& node = (*array)[i];
    const std::string element = fmt::format("[{}]", i);
    if (!node.is_string()) {
      refuse(key.name, node, element, found_and_allowed(node, "the name of an attribute in quotes"));
      continue;
    }
    const std::string& word = node.as_string()->get();
    const auto twice = [&](const Name& name) { return name.text == word; };
    if (std::find(kAlwaysWritten.begin(), kAlwaysWritten.end(), word) != kAlwaysWritten.end()) {
      refuse(key.name, node, element, fmt::format("found '{}'; it is always written: leave it out", word));
    } else if (std::find(known.begin(), known.end(), word) == known.end()) {
      refuse(key.name, node, element, unknown_name("attribute", word, known));
    } else if (std::any_of(out.begin(), out.end(), twice)) {
      refuse(key.name, node, element, fmt::format("found '{}' a second time; allowed: once", word));
    } else {
      out.push_back({word, context_.report.mark(node.source())});
    }
  }
}

void TableReader::learn_every_model() {
  for (const ModelInfo& model : models()) {
    for (const Parameter& parameter : model.parameters) learn(parameter.name);
  }
}

void TableReader::model(const Key& key, MaterialDescription& out) {
  learn(key.name);
  learn(kPresetKey);
  const bool named = table_.contains(kPresetKey);
  const Preset* preset = named ? read_preset(key) : nullptr;
  const ModelInfo* model = preset ? find_model(preset->model) : named ? nullptr : read_model(key);
  if (!model) return learn_every_model();
  out.model = {std::string(model->name),
               context_.report.mark(table_.get(preset ? kPresetKey : key.name)->source())};
  if (preset)
    for (const auto& [parameter, value] : preset->values)
      out.parameters[std::string(parameter)] = {value, out.model.mark};
  for (const Parameter& p : model->parameters)
    if (const std::optional<double> value = read_parameter(p, preset != nullptr))
      out.parameters[std::string(p.name)] = {*value, context_.report.mark(table_.get(p.name)->source())};
}

const ModelInfo* TableReader::read_model(const Key& key) {
  std::vector<std::string_view> names;
  for (const ModelInfo& model : models()) names.push_back(model.name);
  const auto index = read_word(key, names);
  return index ? &models()[*index] : nullptr;
}

const Preset* TableReader::read_preset(const Key& model_key) {
  std::vector<std::string_view> names;
  for (const Preset& p : presets()) names.push_back(p.name);
  const auto index = read_word({kPresetKey, Need::optional, "", "-"}, names);
  if (const toml::node* both = table_.get(model_key.name))
    refuse(model_key.name, *both, "",
           fmt::format("stands beside '{}', which has a model; leave one out", kPresetKey));
  return index ? &presets()[*index] : nullptr;
}

std::optional<double> TableReader::read_parameter(const Parameter& p, bool has_value) {
  const bool needed = p.required() && !has_value && (context_.needs_density || p.name != "density");
  const Key key = {p.name, needed ? Need::required : Need::optional, p.meaning, p.unit};
  if (p.is_switch()) {
    const toml::node* node = find(key, p.range());
    if (!node) return std::nullopt;
    if (const auto on = node->value_exact<bool>()) return *on ? 1 : 0;
    refuse(key.name, *node, p.range());
    return std::nullopt;
  }
  if (!p.choices.empty()) {
    const auto index = read_word(key, p.choices);
    return index ? std::optional<double>(static_cast<double>(*index)) : std::nullopt;
  }
  std::optional<double> value;
  real(key, value, Range::of(p));
  return value;
}

void TableReader::learn_every_shape() {
  only_learn_ = true;
  for (const ShapeType& type : kShapeTypes) {
    ShapeDescription::Kind kind = type.make();
    std::visit([&](auto& k) { fields(*this, k); }, kind);
  }
  only_learn_ = false;
}

void TableReader::kind(const Key& key, ShapeDescription::Kind& out) {
  std::vector<std::string_view> words;
  for (const ShapeType& type : kShapeTypes) words.push_back(type.word);
  const auto index = read_word(key, words);
  if (!index) return learn_every_shape();
  out = kShapeTypes[*index].make();
  std::visit([&](auto& kind) { fields(*this, kind); }, out);
}

void TableReader::shapes(const Key& key, std::vector<ShapeDescription>& out) {
  read_list(key, "an array of shapes", 2, out);
}

void TableReader::materials(const Key& key, std::vector<MaterialDescription>& out) {
  const toml::table* table = read_table(key);
  if (!table) return;
  struct Entry {
    const toml::key* key;
    const toml::node* node;
  };
  std::vector<Entry> entries;
  for (const auto& [name, node] : *table) entries.push_back({&name, &node});
  // In the order of the text (TOML's tables are sorted by name): it numbers the materials.
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    const auto place = [](const Entry& e) {
      const toml::source_position at = e.key->source().begin;
      return std::pair(at.line, at.column);
    };
    return place(a) < place(b);
  });
  for (const auto& [name, node] : entries) {
    const std::string element = "." + printable(name->str());
    MaterialDescription& material = out.emplace_back();
    material.name = name->str();
    if (!node->is_table()) {
      refuse(key.name, *node, element, found_and_allowed(*node, "a table"));
    } else if (!read_all(context_, *node->as_table(), below(key.name) + element, material)) {
      bad_.emplace(key.name);
    }
  }
}

}  // namespace firn
