// "did you mean": the known name closest to what a user wrote.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace firn {

/// The candidate with the smallest edit distance (insert, delete, replace, swap of neighbours; case ignored)
/// to `word`, or "" when none is closer than half the longer word.
std::string_view nearest_name(std::string_view word, std::span<const std::string_view> candidates);

/// "unknown key 'radus'; did you mean 'radius'? known: center, radius" with `what` = "key".
std::string unknown_name(std::string_view what, std::string_view word,
                         std::span<const std::string_view> candidates);

/// `text` as it may stand on a terminal: control characters escaped, cut after `limit` bytes.
std::string printable(std::string_view text, std::size_t limit = 80);

}  // namespace firn
