// Materials by the names artists use: a model, its numbers, and what they look like. A scene that names a
// preset may set any of its parameters otherwise.
#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace firn {

struct Preset {
  using Value = std::pair<std::string_view, double>;
  std::string_view name;   // "dry_sand"
  std::string_view model;  // one of model_info.h
  std::string_view look;   // one line: what it does on screen
  std::string_view source;
  std::span<const Value> values;  // every parameter the model requires, and those that are not its defaults
};

std::span<const Preset> presets();
/// Null when there is no such preset.
const Preset* find_preset(std::string_view name);

}  // namespace firn
