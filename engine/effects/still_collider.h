// A collider that never moves: which nodes lie in it, and the way out from each, is found once when the
// blocks of the grid change and not in every step.
#pragma once

#include <chrono>
#include <vector>

#include <tbb/parallel_for.h>

#include "engine/effects/collider.h"

namespace firn {

template <class Real, int D>
class StillCollider {
 public:
  explicit StillCollider(const Collider& collider) : posed_(collider, 0) {}

  /// Looks at every block of `layout`; holds until the next call. `h`: cell size, m.
  void find(const BlockLayout<D>& layout, double h) {
    const auto start = std::chrono::steady_clock::now();
    nodes_.resize(layout.size());
    first_.resize(layout.size());
    const auto place = [&](std::size_t b) { return BlockNodes<Real, D>{{}, {}, layout.coord(b), h, b}; };
    tbb::parallel_for(std::size_t{0}, layout.size(),
                      [&](std::size_t b) { nodes_[b] = posed_.inside(place(b)); });
    std::size_t count = 0;
    for (std::size_t b = 0; b < layout.size(); ++b) {
      first_[b] = count;
      count += static_cast<std::size_t>(std::popcount(nodes_[b]));
    }
    normals_.resize(count);
    tbb::parallel_for(std::size_t{0}, layout.size(), [&](std::size_t b) {
      const auto block = place(b);
      auto out = normals_.begin() + static_cast<std::ptrdiff_t>(first_[b]);
      for_each_bit(nodes_[b],
                   [&](std::size_t n) { *out++ = posed_.template normal<Real, D>(block.position(n), h); });
    });
    seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  void apply(BlockNodes<Real, D>& block, double) const {
    auto normal = normals_.begin() + static_cast<std::ptrdiff_t>(first_[block.number]);
    for_each_bit(nodes_[block.number], [&](std::size_t n) {
      if (block.nodes[n].m > Real(0)) posed_.hold(block, n, *normal);
      ++normal;
    });
  }

  /// What finding took since the start, s.
  double seconds() const { return seconds_; }
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(NodeSet) + first_.capacity() * sizeof(std::size_t) +
           normals_.capacity() * sizeof(Vector<Real, D>);
  }

 private:
  PosedCollider posed_;
  std::vector<NodeSet> nodes_;      // by block
  std::vector<std::size_t> first_;  // by block, into normals_
  std::vector<Vector<Real, D>> normals_;
  double seconds_ = 0;
};

}  // namespace firn
