// The kernels of the sort for any processor, and what the others are compared with.
#pragma once

#include <cmath>

#include "engine/grid/block_layout.h"
#include "engine/passes/sort_kernels.h"

namespace firn {

/// The same arithmetic as Stencil: a particle and its key never disagree about the first node.
template <class Kernel, class Real, int D>
void plain_cell_keys(const Real* position, std::size_t n, Real inverse_h, std::uint64_t* keys) {
  for (std::size_t i = 0; i < n; ++i) {
    std::array<std::int32_t, D> cell;
    for (std::size_t d = 0; d < D; ++d)
      cell[d] = static_cast<std::int32_t>(
          std::floor(position[d * kTile + i] * inverse_h - Real(Kernel::sort_offset)));
    keys[i] = cell_key<D>(cell);
  }
}

template <class Kernel, class Real, int D>
constexpr SortKernels<Real> plain_sort_kernels() {
  return {plain_cell_keys<Kernel, Real, D>, move_tiles<Real>};
}

}  // namespace firn
