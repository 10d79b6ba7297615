// The cells of one tile of particles. To be compiled without contraction: then the keys are those of the
// plain path, bit for bit.
#pragma once

#include "engine/grid/kernel.h"
#include "engine/vector/tile_stencil.h"

namespace firn::FIRN_ISA {

template <class Real, int D>
void cell_keys(const Real* position, std::size_t, Real inverse_h, std::uint64_t* keys) {
  using L = Lane<Real>;
  alignas(64) std::int32_t cells[D][kTileSize];
  for (int d = 0; d < D; ++d)
    for (int at = 0; at < kTileSize; at += kLanes<Real>) {
      const L x = L::load(position + d * kTileSize + at) * L(inverse_h);
      const auto cell = floor(x - L(QuadraticKernel::sort_offset)).v[0];
      const hn::Rebind<std::int32_t, typename L::Tag> tag;
      if constexpr (sizeof(Real) == 4)
        hn::Store(hn::ConvertTo(tag, cell), tag, cells[d] + at);
      else
        hn::Store(hn::DemoteTo(tag, cell), tag, cells[d] + at);
    }
  for (int i = 0; i < kTileSize; ++i) {
    std::array<std::int32_t, D> cell;
    for (int d = 0; d < D; ++d) cell[static_cast<std::size_t>(d)] = cells[d][i];
    keys[i] = cell_key<D>(cell);
  }
}

}  // namespace firn::FIRN_ISA
