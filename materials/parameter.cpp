#include "materials/parameter.h"

#include <cmath>

#include <fmt/format.h>

namespace firn {

std::string Parameter::range() const {
  const bool below = std::isfinite(max), above = std::isfinite(min);
  if (!below && !above) return "any number";
  if (!below) return fmt::format("{} {:g}", min_open ? ">" : ">=", min);
  if (!above) return fmt::format("{} {:g}", max_open ? "<" : "<=", max);
  return fmt::format("in {}{:g}, {:g}{}", min_open ? '(' : '[', min, max, max_open ? ')' : ']');
}

}  // namespace firn
