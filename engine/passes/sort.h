// Sorts the particles of all batches by cell and finds the blocks they occupy: a counting sort by block and
// cell, stable, so that the order is the same for any number of threads. Keeps its buffers.
#pragma once

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "engine/passes/batch.h"

namespace firn {

template <class Kernel, class Real, int D>
class Sorter {
 public:
  /// Positions must be finite and within kMaxCell cells of the origin. `moved`: the columns whose values
  /// matter; `spare`: one of the others, of which the memory is used instead of a buffer.
  void sort(std::span<Batch<Real, D>> batches, Real h, BlockLayout<D>& layout, ColumnSet moved,
            std::optional<Column> spare = std::nullopt) {
    find_occupied(batches, h);
    layout.rebuild(occupied_);
    for (Batch<Real, D>& batch : batches) {
      place(batch, h, layout);
      batch.particles.reorder(source_, moved, spare);
    }
  }
  std::size_t bytes() const {
    return (bucket_.capacity() + source_.capacity() + counts_.capacity()) * sizeof(std::uint32_t) +
           occupied_.capacity() * sizeof(std::uint64_t);
  }

 private:
  static std::uint64_t key(const Vector<Real, D>& x, Real inverse_h) {
    std::array<std::int32_t, D> cell;
    // The same arithmetic as Stencil: a particle and its key never disagree about the first node.
    for (int d = 0; d < D; ++d)
      cell[static_cast<std::size_t>(d)] =
          static_cast<std::int32_t>(std::floor(x[d] * inverse_h - Real(Kernel::first_node_offset)));
    return cell_key<D>(cell);
  }

  /// Calls f(piece, first, last) for as many pieces of [0, n) as there are threads.
  template <class F>
  static void for_pieces(std::size_t n, std::size_t pieces, F&& f) {
    tbb::parallel_for(std::size_t{0}, pieces,
                      [&](std::size_t k) { f(k, n * k / pieces, n * (k + 1) / pieces); });
  }

  void find_occupied(std::span<const Batch<Real, D>> batches, Real h) {
    pieces_ = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    found_.resize(pieces_);
    for (auto& blocks : found_) blocks.clear();
    for (const Batch<Real, D>& batch : batches) {
      const auto position = batch.particles.template view<Column::position>();
      for_pieces(batch.particles.size(), pieces_, [&](std::size_t k, std::size_t first, std::size_t last) {
        std::uint64_t previous = ~std::uint64_t{0};
        for (std::size_t p = first; p < last; ++p) {
          const std::uint64_t block = block_of_key(key(position.load(p), Real(1) / h));
          if (block == previous) continue;
          previous = block;
          found_[k].push_back(block);
        }
        make_unique(found_[k]);
      });
    }
    occupied_.clear();
    for (const auto& blocks : found_) occupied_.insert(occupied_.end(), blocks.begin(), blocks.end());
    make_unique(occupied_);
  }

  static void make_unique(std::vector<std::uint64_t>& blocks) {
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }

  /// source_ and the batch's block_begin.
  void place(Batch<Real, D>& batch, Real h, const BlockLayout<D>& layout) {
    constexpr std::size_t kCells = kBlockNodes<D>;
    const std::size_t n = batch.particles.size(), buckets = occupied_.size() * kCells;
    bucket_.resize(n);
    source_.resize(n);
    counts_.assign(pieces_ * buckets, 0);
    const auto position = batch.particles.template view<Column::position>();
    for_pieces(n, pieces_, [&](std::size_t k, std::size_t first, std::size_t last) {
      std::uint32_t* counts = counts_.data() + k * buckets;
      std::uint64_t previous = ~std::uint64_t{0};
      std::size_t rank = 0;
      for (std::size_t p = first; p < last; ++p) {
        const std::uint64_t cell = key(position.load(p), Real(1) / h);
        if (block_of_key(cell) != previous) {
          previous = block_of_key(cell);
          rank = layout.find(block_coord<D>(previous));
        }
        bucket_[p] = static_cast<std::uint32_t>(rank * kCells + cell_of_key(cell));
        ++counts[bucket_[p]];
      }
    });
    batch.block_begin.resize(occupied_.size() + 1);
    std::uint32_t next = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
      if (b % kCells == 0) batch.block_begin[b / kCells] = next;
      for (std::size_t k = 0; k < pieces_; ++k) {
        const std::uint32_t count = counts_[k * buckets + b];
        counts_[k * buckets + b] = next;
        next += count;
      }
    }
    batch.block_begin[occupied_.size()] = next;
    for_pieces(n, pieces_, [&](std::size_t k, std::size_t first, std::size_t last) {
      std::uint32_t* places = counts_.data() + k * buckets;
      for (std::size_t p = first; p < last; ++p)
        source_[places[bucket_[p]]++] = static_cast<std::uint32_t>(p);
    });
  }

  std::size_t pieces_ = 1;
  std::vector<std::vector<std::uint64_t>> found_;
  std::vector<std::uint64_t> occupied_;
  std::vector<std::uint32_t> bucket_, source_, counts_;
};

}  // namespace firn
