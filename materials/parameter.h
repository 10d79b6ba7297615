// What a model can be told: the one description from which the scene reader, its errors, the schema and
// `firn materials` are made.
#pragma once

#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace firn {

/// The words of a parameter that is true or false in a scene.
inline constexpr std::string_view kSwitch[] = {"false", "true"};

struct Parameter {
  std::string_view name;                                            // the scene's key
  std::string_view unit;                                            // "Pa", "kg/m^3", "-", "degrees"
  std::string_view meaning;                                         // one line
  double default_value = std::numeric_limits<double>::quiet_NaN();  // NaN: required
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;  // min itself is not allowed
  bool max_open = false;
  // Of a parameter that is one of these words: the number stands for the word's place.
  std::span<const std::string_view> choices{};

  bool required() const { return default_value != default_value; }
  bool allows(double x) const { return (min_open ? x > min : x >= min) && (max_open ? x < max : x <= max); }
  bool is_switch() const { return choices.data() == std::data(kSwitch); }
  /// "> 0", "in (-1, 0.5)", "any number", "\"on\", \"off\"".
  std::string range() const;
  /// A value as a scene has it: "0.3", "\"on\"", "true".
  std::string text(double value) const;
};

/// Numbers by parameter name, complete and in range: what a model is made from.
using ParameterValues = std::map<std::string, double, std::less<>>;

}  // namespace firn
