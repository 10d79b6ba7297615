// Sorts the particles of all batches by cell and finds the blocks they occupy: a counting sort by block and
// cell, stable, so that the order is the same for any number of threads. Keeps its buffers.
//
// Positions are read once: each thread numbers the blocks of its piece as they come and counts by these
// numbers. What the blocks' order is, and with it where each piece's particles go, is found afterwards.
#pragma once

#include <algorithm>
#include <compare>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "engine/passes/batch.h"
#include "engine/passes/block_numbers.h"
#include "engine/passes/plain_sort_kernels.h"

namespace firn {

template <class Kernel, class Real, int D>
class Sorter {
 public:
  explicit Sorter(const SortKernels<Real>& kernels = plain_sort_kernels<Kernel, Real, D>())
      : kernels_(kernels) {}

  /// Positions must be finite and within kMaxCell cells of the origin. `moved`: the columns whose values
  /// matter.
  void sort(std::span<Batch<Real, D>> batches, Real h, BlockLayout<D>& layout, ColumnSet moved) {
    count(batches, Real(1) / h);
    lay_out(batches);
    layout.rebuild(occupied_);
    const std::uint32_t* buckets = buckets_.data();
    for (std::size_t b = 0; b < batches.size(); ++b) {
      ParticleTable<Real, D>& particles = batches[b].particles;
      find_sources(b, {buckets, particles.size()});
      particles.reorder(source_, moved, kernels_.move);
      buckets += particles.size();
    }
  }

  std::size_t bytes() const {
    std::size_t sum = (buckets_.capacity() + source_.capacity()) * sizeof(std::uint32_t) +
                      occupied_.capacity() * sizeof(std::uint64_t) + shares_.capacity() * sizeof(Share);
    for (const Piece& piece : pieces_)
      sum += piece.numbers.bytes() + piece.counts.capacity() * sizeof(std::uint32_t);
    return sum;
  }

 private:
  static constexpr std::size_t kCells = kBlockNodes<D>;

  /// Consecutive tiles of one batch.
  struct Piece {
    BlockNumbers numbers;
    std::vector<std::uint32_t> counts;  // by block number and cell; later where the cell's next particle goes
  };
  /// A block's particles in one piece.
  struct Share {
    std::uint64_t block;
    std::uint32_t piece, number;
    friend auto operator<=>(const Share&, const Share&) = default;
  };

  /// Calls f(piece, first particle, last) for the pieces of a batch of `n` particles.
  template <class F>
  void for_pieces(std::size_t batch, std::size_t n, F&& f) {
    const std::size_t tiles = (n + kTile - 1) / kTile;
    tbb::parallel_for(std::size_t{0}, threads_, [&](std::size_t k) {
      f(pieces_[batch * threads_ + k], tiles * k / threads_ * kTile,
        std::min(n, tiles * (k + 1) / threads_ * kTile));
    });
  }

  /// buckets_: of each particle, its block's number in its piece and its cell.
  void count(std::span<const Batch<Real, D>> batches, Real inverse_h) {
    threads_ = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    pieces_.resize(batches.size() * threads_);
    std::size_t total = 0;
    for (const auto& batch : batches) total += batch.particles.size();
    buckets_.resize(total);
    std::uint32_t* buckets = buckets_.data();
    for (std::size_t b = 0; b < batches.size(); ++b) {
      const auto& particles = batches[b].particles;
      const Real* position = particles.template data<Column::position>();
      for_pieces(b, particles.size(), [&](Piece& piece, std::size_t first, std::size_t last) {
        piece.numbers.clear();
        piece.counts.clear();
        for (std::size_t p = first; p < last; p += kTile)
          count_tile(piece, position + p * D, std::min(kTile, last - p), inverse_h, buckets + p);
      });
      buckets += particles.size();
    }
  }

  void count_tile(Piece& piece, const Real* position, std::size_t n, Real inverse_h, std::uint32_t* buckets) {
    std::uint64_t keys[kTile];
    kernels_.cell_keys(position, n, inverse_h, keys);
    for (std::size_t i = 0; i < n; ++i)
      buckets[i] =
          static_cast<std::uint32_t>(piece.numbers(block_of_key(keys[i])) * kCells + cell_of_key(keys[i]));
    piece.counts.resize(piece.numbers.blocks().size() * kCells);
    for (std::size_t i = 0; i < n; ++i) ++piece.counts[buckets[i]];
  }

  /// occupied_ and each batch's block_begin; counts become places.
  void lay_out(std::span<Batch<Real, D>> batches) {
    shares_.clear();
    for (std::uint32_t k = 0; k < pieces_.size(); ++k)
      for (std::uint32_t n = 0; n < pieces_[k].numbers.blocks().size(); ++n)
        shares_.push_back({pieces_[k].numbers.blocks()[n], k, n});
    std::sort(shares_.begin(), shares_.end());
    occupied_.clear();
    for (const Share& share : shares_)
      if (occupied_.empty() || share.block != occupied_.back()) occupied_.push_back(share.block);
    for (std::size_t b = 0; b < batches.size(); ++b) lay_out(b, batches[b].block_begin);
  }

  void lay_out(std::size_t batch, std::vector<std::size_t>& block_begin) {
    block_begin.clear();
    std::uint32_t next = 0;
    auto share = shares_.begin();
    for (const std::uint64_t block : occupied_) {
      block_begin.push_back(next);
      while (share != shares_.end() && share->block == block && share->piece / threads_ < batch) ++share;
      const auto first = share;
      while (share != shares_.end() && share->block == block && share->piece / threads_ == batch) ++share;
      for (std::size_t cell = 0; cell < kCells; ++cell)
        for (auto s = first; s != share; ++s)
          next += std::exchange(pieces_[s->piece].counts[s->number * kCells + cell], next);
      while (share != shares_.end() && share->block == block) ++share;
    }
    block_begin.push_back(next);
  }

  void find_sources(std::size_t batch, std::span<const std::uint32_t> buckets) {
    source_.resize(buckets.size());
    for_pieces(batch, buckets.size(), [&](Piece& piece, std::size_t first, std::size_t last) {
      std::uint32_t* places = piece.counts.data();
      for (std::size_t p = first; p < last; ++p)
        source_[places[buckets[p]]++] = static_cast<std::uint32_t>(p);
    });
  }

  SortKernels<Real> kernels_;
  std::size_t threads_ = 1;
  std::vector<Piece> pieces_;  // batch by batch, a piece for each thread
  std::vector<Share> shares_;
  std::vector<std::uint64_t> occupied_;
  std::vector<std::uint32_t> buckets_, source_;  // buckets_: batch by batch
};

}  // namespace firn
