// The particles of one material and where each block's share of them begins.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "engine/grid/block_layout.h"
#include "engine/grid/kernel.h"
#include "engine/grid/nodes.h"
#include "engine/particles/particle_table.h"

namespace firn {

template <class Real, int D>
struct Batch {
  ParticleTable<Real, D> particles;
  std::vector<std::size_t> block_begin;  // of each occupied block, and the end of the last

  /// [first, last) of an occupied block.
  std::pair<std::size_t, std::size_t> range(std::size_t block) const {
    return {block_begin[block], block_begin[block + 1]};
  }
};

template <class Real, int D>
struct GridNodes {
  BlockArray<Node<Real, D>, D> nodes;
  BlockArray<Vector<Real, D>, D>
      before;  // momentum, then velocity, without this step's forces: increments only
};

/// Half the edge of a particle that had `volume` at rest, in cells; 0 where the kernel does not ask. A
/// particle is taken to be a cube, and to be a cell at most.
template <class Kernel, class Real, int D>
Real particle_size(Real volume, Real inverse_h) {
  if constexpr (!Kernel::sized) return Real(0);
  const Real edge = D == 1 ? volume : D == 2 ? std::sqrt(volume) : std::cbrt(volume);
  return std::min(Real(0.5) * edge * inverse_h, Real(0.5));
}

/// A particle's kernel in the scratch of its block.
template <class Kernel, class Real, int D>
struct Stencil {
  Real w[D][Kernel::nodes], dw[D][Kernel::nodes];  // dw by x/h
  Vector<Real, D> f;                               // x/h - first node
  int first = 0;                                   // scratch index of the first node

  /// `size`: half the particle's edge, in cells.
  Stencil(const Vector<Real, D>& x, Real size, Real inverse_h, const BlockCoord<D>& block) {
    for (int d = 0; d < D; ++d) {
      const Real cell = x[d] * inverse_h;
      const Real base = Kernel::first_node(cell, size);
      f[d] = cell - base;
      Kernel::weights(f[d], size, w[d], dw[d]);
      first = first * Scratch<int, D>::kEdge + static_cast<int>(base) -
              block[static_cast<std::size_t>(d)] * kBlockEdge + 1;
    }
  }

  /// What stands for the gradient by x/h of a node in a transfer scheme.
  template <class Transfer>
  static Vector<Real, D> force_gradient(Real weight, const Vector<Real, D>& gradient,
                                        const Vector<Real, D>& offset) {
    if constexpr (Transfer::moments)
      return (Real(Kernel::inverse_inertia) * weight) * offset;
    else
      return gradient;
  }

  /// Calls visit(scratch index, weight, gradient by x/h, offset (x_i - x_p)/h) for each node.
  template <class Visit>
  void for_each(Visit&& visit) const {
    walk<0>(0, Real(1), {}, {}, visit);
  }

 private:
  // One axis after the other, so that products of weights are shared and the compiler sees loops of constant
  // length.
  template <int axis, class Visit>
  void walk(int scratch, Real weight, const Vector<Real, D>& gradient, const Vector<Real, D>& offset,
            Visit& visit) const {
    if constexpr (axis == D) {
      visit(static_cast<std::size_t>(first + scratch), weight, gradient, offset);
    } else {
      for (int n = 0; n < Kernel::nodes; ++n) {
        Vector<Real, D> next_gradient = gradient, next_offset = offset;
        for (int d = 0; d < axis; ++d) next_gradient[d] *= w[axis][n];
        next_gradient[axis] = weight * dw[axis][n];
        next_offset[axis] = Real(n) - f[axis];
        walk<axis + 1>(scratch * Scratch<int, D>::kEdge + n, weight * w[axis][n], next_gradient, next_offset,
                       visit);
      }
    }
  }
};

}  // namespace firn
