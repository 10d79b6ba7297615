// What the vectorised kernels are called with: plain memory, the same for every instruction set.
//
// One call works on one block of particles: it reads the velocities of the 3^D grid blocks around it, updates
// its particles tile by tile and leaves what they give to the grid in the block's outbox, which the grid
// update adds up. Blocks write nothing that another block reads, so they run in any order on any number of
// threads with the same bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/grid/block_layout.h"
#include "engine/particles/columns.h"
#include "engine/particles/tile.h"
#include "engine/passes/reports.h"
#include "engine/passes/speed_bound.h"

namespace firn {

inline constexpr int kNodeReals = 4;  // velocity (2D: its third place is the mass) and mass

template <int D>
inline constexpr int kOutboxNodes = power(2 * kBlockEdge, D);

/// Which lines along the last axis of the 8^D nodes around a block its particles touch, a bit each. Right
/// after a sort that is at most half of them, and what nobody touches is neither written nor read.
using LineSet = std::uint64_t;
template <int D>
inline constexpr LineSet kAllLines = ~LineSet{0} >> (64 - power(2 * kBlockEdge, D - 1));

/// Where a column begins in one tile, or in the whole table; null for a column that the table does not have.
template <class Real>
using ColumnPointers = std::array<Real*, kColumnCount>;

/// Projects the state of one tile of particles and writes its Kirchhoff stress, a symmetric column's tile.
template <class Real>
using MaterialKernel = void (*)(const void* model, const ColumnPointers<Real>& tile, Real dt, Real* tau,
                                MaterialReport& report);

/// The parts of a batch's work that are told apart when ticks are counted.
enum TaskPart : std::size_t { kTransferPart, kMaterialPart, kTaskParts };

/// The particles of one material in the block.
template <class Real>
struct BatchTask {
  ColumnPointers<Real> columns;  // of the whole table
  std::size_t first, last;       // particles
  MaterialKernel<Real> update;
  const void* model;
  MaterialReport* report;
  std::uint64_t* ticks;  // kTaskParts of them; null: not counted
};

template <class Real, int D>
struct BlockTask {
  std::span<const BatchTask<Real>> batches;
  BlockCoord<D> block;
  std::array<const Real*, kNeighbours<D>> velocities;       // of each grid block: 4^D nodes of kNodeReals
  std::array<const Real*, kNeighbours<D>> next_velocities;  // of the block that is likely to come next
  LineSet lines, next_lines;                                // that their particles touch before they move
  Real* outbox;                                             // 8^D nodes of kNodeReals
  Real h;                                                   // m
  Real dt;                                                  // s, of the step that ends
  Real next;  // s, of the step that begins: its forces are scattered
  // The answer.
  LineSet touched;  // lines of the outbox that hold something; the others are not written
  Motion motion;
};

/// The kernels of one transfer scheme.
template <class Real, int D>
struct TransferKernels {
  using Kernel = void (*)(BlockTask<Real, D>&);
  Kernel begin;   // particles at rest in memory -> outbox: stress, then P2G for a step of `next`
  Kernel fused;   // G2P of `dt`, return map, P2G for `next`; velocities of particles are not kept
  Kernel finish;  // G2P of `dt`, return map; everything is kept
  Kernel adjust;  // adds the forces of a further `next` (negative: takes back) to the outbox
};

/// What the particles of a block give to the grid; no lines for a block without particles.
template <class Real>
struct OutboxView {
  const Real* nodes = nullptr;
  LineSet lines = 0;
};
/// Of the 3^D blocks around a block of the grid.
template <class Real, int D>
using OutboxViews = std::array<OutboxView<Real>, kNeighbours<D>>;

template <class Real, int D>
struct GridKernels {
  /// The velocities and masses of one block, 4^D nodes of kNodeReals; false when no node is in use, and where
  /// no outbox reaches the block they are left as they were. A node's sum has a fixed order of 2^D terms.
  /// `next`: of the block that is likely to come next.
  bool (*collect)(const OutboxViews<Real, D>& outboxes, const OutboxViews<Real, D>& next, Real* nodes);
  SpeedBound (*speed_bound)(const Real* nodes, Real lightest);
};

}  // namespace firn
