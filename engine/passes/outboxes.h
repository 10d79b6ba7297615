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
  std::size_t bytes() const { return values_.capacity() * sizeof(Node<Real, D>); }

 private:
  std::vector<Node<Real, D>, tbb::cache_aligned_allocator<Node<Real, D>>> values_;
};

}  // namespace firn
