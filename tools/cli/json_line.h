// One JSON value per line from someone we do not trust: length, nesting and duplicate keys are bounded before
// and while parsing.
#pragma once

#include <istream>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace firn {

inline constexpr std::size_t kLongestJsonLine = std::size_t{1}
                                                << 16;  // bytes; ten times the longest sensible line
inline constexpr int kDeepestJson = 8;                  // an object of lists of lists needs 3

/// Reads up to the next newline or the end; false when there is nothing left. Of a longer line only the first
/// kLongestJsonLine + 1 bytes are kept, so memory stays bounded and `parse_json_line` refuses it.
bool read_bounded_line(std::istream& in, std::string& line);

/// Throws Error{ExitCode::input} that says what is wrong.
nlohmann::json parse_json_line(std::string_view line);

}  // namespace firn
