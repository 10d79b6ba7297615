// One block of the grid as an effect sees it: velocities at known places.
#pragma once

#include <span>

#include "engine/grid/nodes.h"
#include "engine/shapes/shape.h"

namespace firn {

template <class Real, int D>
struct BlockNodes {
  std::span<Node<Real, D>> nodes;     // v is velocity; nodes with m = 0 are not in use
  std::span<Vector<Real, D>> before;  // velocity without this step's forces; empty unless the scheme keeps it
  BlockCoord<D> block;
  double h;                // m
  std::size_t number = 0;  // of the block in its layout

  /// In 2D and 1D the missing coordinates are zero.
  Vec3 position(std::size_t node) const {
    Vec3 x = Vec3::Zero();
    for (int d = D - 1; d >= 0; --d, node /= kBlockEdge)
      x[d] = h * (block[static_cast<std::size_t>(d)] * kBlockEdge + static_cast<int>(node % kBlockEdge));
    return x;
  }
};

template <class Real, int D>
Vector<Real, D> to_vector(const Vec3& x) {
  Vector<Real, D> out;
  for (int d = 0; d < D; ++d) out[d] = static_cast<Real>(x[d]);
  return out;
}

}  // namespace firn
