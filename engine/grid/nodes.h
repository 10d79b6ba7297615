// The nodes of the grid's blocks and the private copy of a neighbourhood that one block of particles works
// on.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <tbb/cache_aligned_allocator.h>

#include "engine/grid/block_layout.h"
#include "engine/math/matrix.h"

namespace firn {

/// While particles are scattered `v` is momentum (kg m/s); after the grid update it is velocity (m/s).
/// Four numbers in 2D too, the last unused: what the vectorised path loads at once.
template <class Real, int D>
struct alignas(D == 2 ? 4 * sizeof(Real) : sizeof(Real)) Node {
  Vector<Real, D> v;
  Real m;
};

/// Node values of type T, block after block in the order of a layout.
template <class T, int D>
class BlockArray {
 public:
  void reset(const BlockLayout<D>& layout) { values_.assign(layout.size() * kBlockNodes<D>, T{}); }
  /// Without a value for what is new.
  void resize(const BlockLayout<D>& layout) { values_.resize(layout.size() * kBlockNodes<D>); }
  void swap(BlockArray& other) { values_.swap(other.values_); }
  std::span<T> block(std::size_t b) { return {values_.data() + b * kBlockNodes<D>, kBlockNodes<D>}; }
  std::span<const T> block(std::size_t b) const {
    return {values_.data() + b * kBlockNodes<D>, kBlockNodes<D>};
  }
  std::size_t bytes() const { return values_.capacity() * sizeof(T); }

 private:
  std::vector<T, tbb::cache_aligned_allocator<T>> values_;
};

/// 8 nodes an axis around a block: one below it, three above.
template <class T, int D>
struct Scratch {
  static constexpr int kEdge = 2 * kBlockEdge;
  static constexpr int kSize = power(kEdge, D);
  std::array<T, kSize> node;

  /// Calls f(T& scratch node, int neighbour, int node in that neighbour) for all nodes.
  template <class F>
  void for_each(F&& f) {
    for (int s = 0; s < kSize; ++s) {
      int neighbour = 0, local = 0;
      for (int d = 0, stride = kSize / kEdge, rest = s; d < D; ++d) {
        const int n = rest / stride + kBlockEdge - 1;  // counted from the lower neighbour's first node
        rest %= stride;
        stride /= kEdge;
        neighbour = neighbour * 3 + n / kBlockEdge;
        local = local * kBlockEdge + n % kBlockEdge;
      }
      f(node[static_cast<std::size_t>(s)], neighbour, local);
    }
  }

  void load(const BlockArray<T, D>& grid, const typename BlockLayout<D>::Neighbours& blocks) {
    for_each([&](T& value, int neighbour, int local) {
      value = grid.block(blocks[static_cast<std::size_t>(neighbour)])[static_cast<std::size_t>(local)];
    });
  }
};

}  // namespace firn
