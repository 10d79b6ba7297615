#include "engine/base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace firn {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Optimal string alignment distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

// For what may be the first word of a name alone, mistyped ("snw" for "snow_stomakhin_2013").
std::size_t stem_distance(std::string_view word, std::string_view name) {
  const std::string_view stem = name.substr(0, name.find('_'));
  const std::size_t distance = edit_distance(word, stem);
  return stem.size() < name.size() && 3 * distance <= stem.size() ? distance + 1 : name.size() + word.size();
}

// Nobody mistypes more than this; it also bounds the cost of a hostile scene.
constexpr std::size_t kLongestWord = 64;

}  // namespace

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates) {
  if (word.size() > kLongestWord) return {};
  std::string_view best;
  std::size_t best_distance = word.size() + kLongestWord;
  for (std::string_view candidate : candidates) {
    // What was written may be the start of the name ("snow" for "snow_stomakhin_2013").
    const bool prefix = word.size() >= 3 && candidate.substr(0, word.size()) == word;
    const std::size_t distance =
        prefix ? 1 : std::min(edit_distance(word, candidate), stem_distance(word, candidate));
    if (2 * distance <= std::max(word.size(), candidate.size()) && distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string unknown_name(std::string_view what, std::string_view word,
                         std::span<const std::string_view> candidates) {
  const std::string_view near = nearest_name(word, candidates);
  const std::string hint = near.empty() ? "" : fmt::format(" did you mean '{}'?", near);
  return fmt::format("unknown {} '{}';{} known: {}", what, printable(word), hint,
                     fmt::join(candidates, ", "));
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  for (char c : text.substr(0, limit)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
  }
  if (text.size() > limit) out += "...";
  return out;
}

}  // namespace firn
