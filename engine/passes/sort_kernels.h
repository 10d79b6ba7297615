// What the sort spends its time in, which every instruction set has its own version of.
#pragma once

#include <cstdint>

#include "engine/particles/move_tiles.h"

namespace firn {

template <class Real>
struct SortKernels {
  /// The keys (cell_key) of the first nodes of the first `n` particles of a tile; there is room for all of
  /// them. `position`: the tile's column.
  using CellKeys = void (*)(const Real* position, std::size_t n, Real inverse_h, std::uint64_t* keys);
  CellKeys cell_keys;
  MoveTiles<Real> move;
};

}  // namespace firn
