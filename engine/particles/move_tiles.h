// Moving the values of a column's particles to new places, tile by tile.
#pragma once

#include <cstdint>

#include "engine/particles/tile.h"

namespace firn {

/// Fills `tiles` whole tiles of `width` components: particle i of `to` becomes particle source[i] of `from`.
template <class Real>
using MoveTiles = void (*)(const Real* from, Real* to, const std::uint32_t* source, std::size_t tiles,
                           int width);

/// The same for `n` particles, of which the last tile may be in part.
template <class Real>
void move_particles(const Real* from, Real* to, const std::uint32_t* source, std::size_t n, int width) {
  for (std::size_t i = 0; i < n; ++i) {
    const Real* in = from + tile_index(source[i], 0, width);
    Real* out = to + tile_index(i, 0, width);
    for (std::size_t c = 0; c < static_cast<std::size_t>(width); ++c) out[c * kTile] = in[c * kTile];
  }
}

template <class Real>
void move_tiles(const Real* from, Real* to, const std::uint32_t* source, std::size_t tiles, int width) {
  move_particles(from, to, source, tiles * kTile, width);
}

}  // namespace firn
