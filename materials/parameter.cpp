#include "materials/parameter.h"

#include <cmath>

#include <fmt/format.h>

namespace firn {

std::string Parameter::range() const {
  if (!choices.empty()) {
    std::string out;
    for (std::size_t k = 0; k < choices.size(); ++k)
      out += (k > 0 ? ", " : "") + text(static_cast<double>(k));
    return out;
  }
  const bool below = std::isfinite(max), above = std::isfinite(min);
  if (!below && !above) return "any number";
  if (!below) return fmt::format("{} {:g}", min_open ? ">" : ">=", min);
  if (!above) return fmt::format("{} {:g}", max_open ? "<" : "<=", max);
  return fmt::format("in {}{:g}, {:g}{}", min_open ? '(' : '[', min, max, max_open ? ')' : ']');
}

std::string Parameter::text(double value) const {
  if (choices.empty()) return fmt::format("{:g}", value);
  const std::string_view word = choices[static_cast<std::size_t>(value)];
  return is_switch() ? std::string(word) : fmt::format("\"{}\"", word);
}

}  // namespace firn
