// Sorts the particles of all batches by cell and finds the blocks they occupy.
#pragma once

#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "engine/passes/batch.h"

namespace firn {
namespace detail {

struct KeyedParticle {
  std::uint64_t key;
  std::uint32_t index;
  // Ties by index: one order, whatever the threads do.
  friend bool operator<(const KeyedParticle& a, const KeyedParticle& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  }
};

template <class Kernel, class Real, int D>
std::vector<KeyedParticle> keys(const ParticleTable<Real, D>& particles, Real h) {
  const auto position = particles.template view<Column::position>();
  std::vector<KeyedParticle> out(particles.size());
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t p) {
    const Vector<Real, D> x = position.load(p);
    std::array<std::int32_t, D> cell;
    // The same arithmetic as Stencil: a particle and its key never disagree about the first node.
    for (int d = 0; d < D; ++d)
      cell[static_cast<std::size_t>(d)] =
          static_cast<std::int32_t>(std::floor(x[d] * (Real(1) / h) - Real(Kernel::first_node_offset)));
    out[p] = {cell_key<D>(cell), static_cast<std::uint32_t>(p)};
  });
  return out;
}

}  // namespace detail

/// Positions must be finite and within kMaxCell cells of the origin.
template <class Kernel, class Real, int D>
BlockLayout<D> sort_and_activate(std::span<Batch<Real, D>> batches, Real h) {
  std::vector<std::vector<detail::KeyedParticle>> keys;
  std::vector<std::uint64_t> occupied;
  for (Batch<Real, D>& batch : batches) {
    auto& sorted = keys.emplace_back(detail::keys<Kernel, Real, D>(batch.particles, h));
    tbb::parallel_sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> source(sorted.size());
    for (std::size_t p = 0; p < sorted.size(); ++p) {
      source[p] = sorted[p].index;
      const std::uint64_t block = block_of_key(sorted[p].key);
      if (p == 0 || block != block_of_key(sorted[p - 1].key)) occupied.push_back(block);
    }
    batch.particles.reorder(source);
  }
  std::sort(occupied.begin(), occupied.end());
  occupied.erase(std::unique(occupied.begin(), occupied.end()), occupied.end());

  for (std::size_t b = 0; b < batches.size(); ++b) {
    auto& begin = batches[b].block_begin;
    begin.assign(occupied.size() + 1, keys[b].size());
    std::size_t p = 0;
    for (std::size_t block = 0; block < occupied.size(); ++block) {
      while (p < keys[b].size() && block_of_key(keys[b][p].key) < occupied[block]) ++p;
      begin[block] = p;
    }
  }
  return BlockLayout<D>(occupied);
}

}  // namespace firn
