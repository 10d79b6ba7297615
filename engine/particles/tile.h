// How columns are cut into tiles. Sixteen particles of one component are one contiguous load for a vector
// lane, and one particle's components are close together for the plain path.
#pragma once

#include <cstddef>

namespace firn {

inline constexpr std::size_t kTile = 16;

/// Where component `c` of particle `i` stands in a column of `n` components.
constexpr std::size_t tile_index(std::size_t i, int c, int n) {
  return (i / kTile * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)) * kTile + i % kTile;
}

}  // namespace firn
