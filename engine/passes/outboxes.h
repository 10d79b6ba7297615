// What the blocks of particles give to the grid, kept block by block until the grid update adds it up. Every
// block writes its own, so the scatter needs no atomics, no colours and no order; the sum of a node has a
// fixed order of at most 2^D terms, so its bits do not depend on the threads.
#pragma once

#include <vector>

#include <tbb/cache_aligned_allocator.h>

#include "engine/grid/nodes.h"

namespace firn {

template <class Real, int D>
class Outboxes {
 public:
  static constexpr std::size_t kNodes = power(2 * kBlockEdge, D);

  void resize(std::size_t blocks) { values_.resize(blocks * kNodes); }
  Node<Real, D>* block(std::size_t b) { return values_.data() + b * kNodes; }
  const Node<Real, D>* block(std::size_t b) const { return values_.data() + b * kNodes; }
  std::size_t bytes() const { return values_.capacity() * sizeof(Node<Real, D>); }

 private:
  std::vector<Node<Real, D>, tbb::cache_aligned_allocator<Node<Real, D>>> values_;
};

namespace detail {

// An outbox covers, along each axis, the last node of the block below (its 0), the block's own four (1 to 4)
// and the first three of the block above (5 to 7). Seen from the block that receives: which of its nodes a
// source at -1, 0, +1 has, and where the source keeps the first of them.
inline constexpr int kFirstNode[3] = {0, 0, 3}, kLastNode[3] = {3, 4, 4}, kFirstPlace[3] = {5, 1, 0};

template <int axis, class Real, int D>
void add_outbox(const Node<Real, D>* from, Node<Real, D>* to, const BlockCoord<D>& source) {
  const int s = source[axis];
  constexpr int from_stride = power(2 * kBlockEdge, D - 1 - axis),
                to_stride = power(kBlockEdge, D - 1 - axis);
  from += kFirstPlace[s] * from_stride;
  for (int n = kFirstNode[s]; n < kLastNode[s]; ++n, from += from_stride) {
    if constexpr (axis + 1 < D) {
      add_outbox<axis + 1, Real, D>(from, to + n * to_stride, source);
    } else {
      to[n].v += from->v;
      to[n].m += from->m;
    }
  }
}

}  // namespace detail

/// The nodes of one block: everything its `sources` have for it.
template <class Real, int D>
void collect(const Outboxes<Real, D>& outboxes, const typename BlockLayout<D>::Neighbours& sources,
             std::span<Node<Real, D>> nodes) {
  for (auto& node : nodes) node = {};
  for (int s = 0; s < kNeighbours<D>; ++s) {
    const std::uint32_t block = sources[static_cast<std::size_t>(s)];
    if (block == BlockLayout<D>::kNone) continue;
    BlockCoord<D> offset;
    for (int d = D - 1, rest = s; d >= 0; --d, rest /= 3) offset[static_cast<std::size_t>(d)] = rest % 3;
    detail::add_outbox<0, Real, D>(outboxes.block(block), nodes.data(), offset);
  }
}

}  // namespace firn
