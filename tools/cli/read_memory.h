// Reading memory and doing next to nothing with it: as fast as a core can.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>

namespace firn {

inline constexpr std::size_t kLineNumbers = 8;  // of a cache line

/// Of whole cache lines. One sum a place in the line: additions that do not wait for each other.
inline std::uint64_t sum_of(std::span<const std::uint64_t> lines) {
  std::uint64_t sums[kLineNumbers] = {};
  for (std::size_t i = 0; i < lines.size(); i += kLineNumbers)
    for (std::size_t k = 0; k < kLineNumbers; ++k) sums[k] += lines[i + k];
  return std::accumulate(sums, sums + kLineNumbers, std::uint64_t{0});
}

}  // namespace firn
