#include "engine/scene/key_depth.h"

#include <algorithm>

namespace firn {
namespace {

// The end of the string that starts at `begin`, or of the text.
std::size_t skip_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string_view triple = text.substr(begin, 3);
  const bool multi_line = triple.size() == 3 && triple[1] == quote && triple[2] == quote;
  const std::size_t width = multi_line ? 3 : 1;
  for (std::size_t i = begin + width; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == '\n' && !multi_line) {
      return i;  // unterminated: the parser will say so
    } else if (text.substr(i, width) == triple.substr(0, width)) {
      return i + width;
    }
  }
  return text.size();
}

TextPlace place_of(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const auto newlines = std::count(before.begin(), before.end(), '\n');
  const std::string_view line = before.substr(before.find_last_of('\n') + 1);
  const auto points = std::count_if(line.begin(), line.end(),
                                    [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
  return {static_cast<int>(newlines) + 1, static_cast<int>(points) + 1};
}

}  // namespace

std::optional<TextPlace> too_deep_key(std::string_view toml) {
  int dots = 0;  // since the last character that no key can hold
  for (std::size_t i = 0; i < toml.size();) {
    const char c = toml[i];
    if (c == '"' || c == '\'') {
      i = skip_string(toml, i);
      continue;
    }
    if (c == '#') {
      i = std::min(toml.find('\n', i), toml.size());
      continue;
    }
    if (c == '.' && ++dots >= kDeepestKey) return place_of(toml, i);
    if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots = 0;
    ++i;
  }
  return std::nullopt;
}

}  // namespace firn
