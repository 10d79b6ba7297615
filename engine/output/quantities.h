// Sizes and times as people read them, for messages and the progress line.
#pragma once

#include <cstdint>
#include <string>

namespace firn {

/// "0 B", "512 B", "12.3 kB", "4.2 GB": powers of 1000, as disks are sold and file managers show.
std::string readable_bytes(std::uint64_t bytes);

/// "8 s", "3 min 20 s", "2 h 05 min", "4 d 3 h".
std::string readable_seconds(double seconds);

}  // namespace firn
