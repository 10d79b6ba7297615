#include "tools/cli/study/parse.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

struct Unit {
  std::string_view word;
  double factor;
};

/// A positive number and one of the units; empty when it is none.
std::optional<double> parse(std::string_view text, std::span<const Unit> units) {
  double number = 0;
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failed != std::errc() || !(number > 0) || !std::isfinite(number)) return std::nullopt;
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  for (const Unit& unit : units)
    if (rest == unit.word) return number * unit.factor;
  return std::nullopt;
}

}  // namespace

double parse_error(const std::string& text) {
  constexpr std::array<Unit, 2> units = {{{"%", 0.01}, {"", 1}}};
  if (const auto value = parse(text, units)) return *value;
  throw Error(ExitCode::input,
              fmt::format("--error {}: expected a relative error, as in 1% or 0.01", printable(text)));
}

double parse_seconds(const std::string& text) {
  constexpr std::array<Unit, 5> units = {{{"ms", 1e-3}, {"s", 1}, {"m", 60}, {"h", 3600}, {"", 1}}};
  if (const auto value = parse(text, units)) return *value;
  throw Error(ExitCode::input,
              fmt::format("--budget {}: expected a time, as in 500ms, 90s, 10m or 2h", printable(text)));
}

}  // namespace firn
