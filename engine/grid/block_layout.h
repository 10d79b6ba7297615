// Which blocks of the grid exist: those that hold particles and their neighbours. Memory follows the
// material, not the extent of the domain.
//
// A block is 4 nodes along each axis. A particle belongs to the block of its first kernel node at the last
// sort; it may drift by one cell before the next, so what it touches lies between one node below its block
// and three above: inside the 3^D blocks around it. Blocks whose coordinates agree modulo 3 never share one
// of those, which gives 3^D colours that can be scattered to in parallel, without atomics and with the same
// sums for any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace firn {

inline constexpr int kBlockEdge = 4;

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

template <int D>
inline constexpr int kBlockNodes = power(kBlockEdge, D);
template <int D>
inline constexpr int kNeighbours = power(3, D);

template <int D>
using BlockCoord = std::array<std::int32_t, D>;

/// Cells beyond this many from the origin have no key; positions are checked against it before any cast.
inline constexpr std::int32_t kMaxCell = 1 << 20;

/// Sort key of a cell: the block in lexicographic order, then the cell in its block.
/// Each coordinate must lie in [-kMaxCell, kMaxCell).
template <int D>
constexpr std::uint64_t cell_key(const std::array<std::int32_t, D>& cell) {
  std::uint64_t block = 0, local = 0;
  for (int d = 0; d < D; ++d) {
    const auto shifted = static_cast<std::uint32_t>(cell[static_cast<std::size_t>(d)] + kMaxCell);
    block = block << 19 | shifted / kBlockEdge;
    local = local << 2 | shifted % kBlockEdge;
  }
  return block << 6 | local;
}
constexpr std::uint64_t block_of_key(std::uint64_t key) {
  return key >> 6;
}
/// Which cell of its block, in [0, 64).
constexpr std::uint32_t cell_of_key(std::uint64_t key) {
  return static_cast<std::uint32_t>(key & 63);
}
template <int D>
constexpr BlockCoord<D> block_coord(std::uint64_t block) {
  BlockCoord<D> out{};
  for (int d = D - 1; d >= 0; --d) {
    out[static_cast<std::size_t>(d)] = static_cast<std::int32_t>(block & 0x7ffff) - kMaxCell / kBlockEdge;
    block >>= 19;
  }
  return out;
}

template <int D>
class BlockLayout {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  using Neighbours = std::array<std::uint32_t, kNeighbours<D>>;

  BlockLayout() = default;
  explicit BlockLayout(std::span<const std::uint64_t> occupied) { rebuild(occupied); }
  /// `occupied`: the blocks with particles (block_of_key), sorted and unique. Keeps its memory.
  void rebuild(std::span<const std::uint64_t> occupied);

  /// All blocks: the occupied ones first, in their order, then the rest of their neighbourhoods.
  std::size_t size() const { return coords_.size(); }
  std::size_t occupied() const { return neighbours_.size(); }
  const BlockCoord<D>& coord(std::size_t block) const { return coords_[block]; }
  /// kNone where there is no such block.
  std::uint32_t find(const BlockCoord<D>& coord) const;

  /// Of an occupied block: the 3^D blocks around it, itself in the middle, last axis fastest.
  const Neighbours& neighbours(std::size_t block) const { return neighbours_[block]; }
  /// Of any block: the occupied ones among the 3^D blocks around it, kNone for the others.
  const Neighbours& sources(std::size_t block) const { return sources_[block]; }
  /// The occupied blocks of each colour.
  const std::array<std::vector<std::uint32_t>, kNeighbours<D>>& colours() const { return colours_; }

  std::size_t bytes() const;

 private:
  std::uint32_t add(const BlockCoord<D>& coord);
  std::size_t slot(const BlockCoord<D>& coord) const;

  std::vector<BlockCoord<D>> coords_;
  std::vector<Neighbours> neighbours_, sources_;
  std::array<std::vector<std::uint32_t>, kNeighbours<D>> colours_;
  std::vector<std::uint32_t> table_;  // open addressing, a power of two, at most half full
};

}  // namespace firn
