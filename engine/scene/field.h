// What can be said about one key of a scene, apart from its value: see fields.h.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "materials/parameter.h"

namespace firn {

enum class Need { required, optional };

struct Key {
  std::string_view name;
  Need need;
  std::string_view meaning;     // one line
  std::string_view unit = "-";  // "-": dimensionless, or not a number
  std::string_view sample =
      {};  // a value in TOML, for keys that the example scene can only show as a comment
};

/// Which real numbers a key takes; never NaN.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false, max_open = false;  // the limit itself is not allowed
  bool infinite = false;                    // takes infinity where it has no limit

  /// Models limit what has to be finite.
  static Range of(const Parameter& p) { return {p.min, p.max, p.min_open, p.max_open, true}; }
  Parameter parameter() const {
    Parameter p;
    p.min = min, p.max = max, p.min_open = min_open, p.max_open = max_open;
    return p;
  }
  bool allows(double x) const { return parameter().allows(x) && (infinite ? x == x : std::isfinite(x)); }
  std::string text() const { return parameter().range(); }
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{.min = 0, .min_open = true};
inline constexpr Range kNotNegative{.min = 0};
inline constexpr Range kFraction{.min = 0, .max = 1};

struct IntegerRange {
  std::int64_t min, max = std::numeric_limits<std::int64_t>::max();
};

/// One of the words a key takes.
template <class E>
struct Choice {
  std::string_view word;
  E value;
  std::string_view meaning;
};

/// What a scene writes for `value`, which is among the choices.
template <class E, std::size_t n>
constexpr std::string_view word_of(const std::array<Choice<E>, n>& choices, E value) {
  return std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.value == value; })->word;
}

/// What a vector's components stand for: a rotation in a plane scene turns about z, a position has no z
/// there.
enum class Axes { along, about };

/// Whether component `axis` can be other than 0 in a scene of that dimension.
constexpr bool has_axis(Axes axes, int axis, int dimension) {
  if (axes == Axes::along) return axis < dimension;
  return dimension == 3 || (dimension == 2 && axis == 2);
}

}  // namespace firn
