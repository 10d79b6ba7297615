// Momentum to velocity on every node, then the scene's effects, block by block.
#pragma once

#include <tbb/parallel_for.h>

#include "engine/effects/grid_effects.h"
#include "engine/passes/batch.h"

namespace firn {

/// One block, `block.before` with it when the scheme keeps one.
template <class Real, int D>
void update_block(BlockNodes<Real, D>& block, double dt, std::span<const StepEffect<Real, D>> effects) {
  bool used = false;
  for (std::size_t n = 0; n < block.nodes.size(); ++n) {
    Node<Real, D>& node = block.nodes[n];
    // A weight so small that the mass underflows to zero carries a momentum below rounding.
    if (!(node.m > Real(0))) continue;
    used = true;
    for (int d = 0; d < D; ++d) node.v[d] /= node.m;
    if (!block.before.empty())
      for (int d = 0; d < D; ++d) block.before[n][d] /= node.m;
  }
  if (used)
    for (const StepEffect<Real, D>& effect : effects) apply(effect, block, dt);
}

template <class Transfer, class Real, int D>
void grid_update(const BlockLayout<D>& layout, double h, double dt, std::span<const StepEffect<Real, D>> effects,
                 GridNodes<Real, D>& grid) {
  tbb::parallel_for(std::size_t{0}, layout.size(), [&](std::size_t b) {
    BlockNodes<Real, D> block{grid.nodes.block(b), {}, layout.coord(b), h, b};
    if constexpr (Transfer::increments) block.before = grid.before.block(b);
    update_block(block, dt, effects);
  });
}

}  // namespace firn
