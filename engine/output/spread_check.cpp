#include "engine/output/spread_check.h"

#include <cmath>
#include <cstdint>
#include <unordered_set>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/output/quantities.h"

namespace firn {
namespace {

// Half of what 32 bits hold, so that no sum of an index and a node's extent overflows either.
constexpr double kLargestIndex = 1 << 30;

struct Cell {
  std::int32_t x, y, z;
  friend bool operator==(const Cell&, const Cell&) = default;
  Cell parent(int levels) const { return {x >> levels, y >> levels, z >> levels}; }
};

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 / golden ratio: spreads neighbours
    std::uint64_t h = static_cast<std::uint32_t>(c.x);
    h = h * kOdd + static_cast<std::uint32_t>(c.y);
    h = h * kOdd + static_cast<std::uint32_t>(c.z);
    return static_cast<std::size_t>((h * kOdd) ^ (h >> 29));
  }
};
using CellSet = std::unordered_set<Cell, CellHash>;

CellSet parents(const CellSet& cells, int levels) {
  CellSet out;
  for (const Cell& cell : cells) out.insert(cell.parent(levels));
  return out;
}

[[noreturn]] void fail(const FrameView& frame, std::size_t particle, const float* x, const std::string& why) {
  std::int64_t id = 0;
  frame.copy_id(particle, {&id, 1});
  throw Error(ExitCode::numerics, fmt::format("frame {}: particle {} at ({}, {}, {}) m {}", frame.frame, id,
                                              x[0], x[1], x[2], why));
}

// The leaves (8^3 voxels) the particles lie in.
CellSet occupied_leaves(const FrameView& frame, std::span<const float> positions, double voxel_size) {
  CellSet leaves;
  Cell last{};
  for (std::size_t i = 0; i < frame.particles; ++i) {
    const float* x = &positions[3 * i];
    std::int32_t index[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double cells = std::floor(static_cast<double>(x[axis]) / voxel_size + 0.5);
      if (!(std::abs(cells) <= kLargestIndex)) {
        fail(frame, i, x,
             std::isfinite(x[axis])
                 ? fmt::format("is too far out to be stored (limit: {} m)", kLargestIndex * voxel_size)
                 : std::string("has no finite position"));
      }
      index[axis] = static_cast<std::int32_t>(cells);
    }
    const Cell leaf = Cell{index[0], index[1], index[2]}.parent(3);
    if (i == 0 || leaf != last) leaves.insert(leaf);  // neighbours in memory mostly share a leaf
    last = leaf;
  }
  return leaves;
}

}  // namespace

void check_spread(const FrameView& frame, std::span<const float> positions, double voxel_size) {
  const CellSet leaves = occupied_leaves(frame, positions, voxel_size);
  const CellSet lower = parents(leaves, 4), upper = parents(lower, 5);
  // Two trees exist at once (point indices and point data). Per node: 8^3 voxel offsets and the attribute
  // arrays; 16^3 and 32^3 child pointers with two masks.
  constexpr std::uint64_t kLeaf = 8 << 10, kLower = 68 << 10, kUpper = 540 << 10;
  const std::uint64_t bytes = leaves.size() * kLeaf + lower.size() * kLower + upper.size() * kUpper;
  // Bodies, and rubble of one particle a leaf, stay far below; runaways in all directions do not.
  const std::uint64_t limit = (std::uint64_t{1} << 30) + frame.particles * 2 * kLeaf;
  if (bytes > limit) {
    throw Error(
        ExitCode::numerics,
        fmt::format(
            "frame {}: the {} particles are scattered over {} separate regions of {} m; the grid to store "
            "them would take {}. Particles fly off: check the time step and the boundaries of the scene",
            frame.frame, frame.particles, lower.size(), 128 * voxel_size, readable_bytes(bytes)));
  }
}

}  // namespace firn
