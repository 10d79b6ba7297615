// A key like a.a.a.a... makes a table in a table for each of its parts, and freeing those recurses: a line of
// two hundred thousand parts overflows the stack inside the TOML library. Such keys are found before it sees
// the text.
#pragma once

#include <optional>
#include <string_view>

namespace firn {

/// More than any scene needs.
inline constexpr int kDeepestKey = 16;

struct TextPlace {
  int line, column;  // 1-based; columns count code points
};

/// Where the first key of more than kDeepestKey parts passes that limit.
std::optional<TextPlace> too_deep_key(std::string_view toml);

}  // namespace firn
