// Momentum to velocity on every node, then the scene's effects, block by block.
#pragma once

#include <functional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "engine/effects/grid_effects.h"
#include "engine/passes/batch.h"

namespace firn {

/// One block, `block.before` with it when the scheme keeps one. Nodes lighter than `least` kg are emptied,
/// with the momentum that they carry; answers how many.
template <class Real, int D>
std::int64_t update_block(BlockNodes<Real, D>& block, double dt, std::span<const StepEffect<Real, D>> effects,
                          Real least) {
  bool used = false;
  std::int64_t ignored = 0;
  for (std::size_t n = 0; n < block.nodes.size(); ++n) {
    Node<Real, D>& node = block.nodes[n];
    // A weight so small that the mass underflows to zero carries a momentum below rounding.
    if (!(node.m > Real(0))) continue;
    if (node.m < least) {
      node = {};
      if (!block.before.empty()) block.before[n] = {};
      ++ignored;
      continue;
    }
    used = true;
    for (int d = 0; d < D; ++d) node.v[d] /= node.m;
    if (!block.before.empty())
      for (int d = 0; d < D; ++d) block.before[n][d] /= node.m;
  }
  if (used)
    for (const StepEffect<Real, D>& effect : effects) apply(effect, block, dt);
  return ignored;
}

/// Answers how many nodes were ignored.
template <class Transfer, class Real, int D>
std::int64_t grid_update(const BlockLayout<D>& layout, double h, double dt,
                         std::span<const StepEffect<Real, D>> effects, Real least, GridNodes<Real, D>& grid) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, layout.size()), std::int64_t{0},
      [&](const tbb::blocked_range<std::size_t>& range, std::int64_t ignored) {
        for (std::size_t b = range.begin(); b < range.end(); ++b) {
          BlockNodes<Real, D> block{grid.nodes.block(b), {}, layout.coord(b), h, b};
          if constexpr (Transfer::increments) block.before = grid.before.block(b);
          ignored += update_block(block, dt, effects, least);
        }
        return ignored;
      },
      std::plus<>());
}

}  // namespace firn
