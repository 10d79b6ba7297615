// Errors and times as a user gives them on the command line.
#pragma once

#include <string>

namespace firn {

/// "1%" or "0.01", relative. Throws Error{input}.
double parse_error(const std::string& text);

/// "500ms", "90s", "10m", "2h", or seconds. Throws Error{input}.
double parse_seconds(const std::string& text);

}  // namespace firn
