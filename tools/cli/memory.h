// How much memory a run may use.
#pragma once

#include <cstdint>
#include <string>

namespace firn {

/// Bytes: the smallest of what the system has free, the control group's limit and RLIMIT_AS.
std::uint64_t available_memory();

/// "8G", "500M", "1073741824" (powers of 1024). Throws Error{input}.
std::uint64_t parse_bytes(const std::string& text);

}  // namespace firn
