// The block kernels of the production path: grid to particles, return map, particles to grid, one tile of 16
// particles after the other while it is in cache. The formulas are those of engine/passes (p2g.h, g2p.h);
// lanes hold sixteen particles for what is per particle, rows hold one particle's nodes for what is per node.
#pragma once

#include "engine/base/bits.h"
#include "engine/base/tick_clock.h"
#include "engine/passes/transfer.h"
#include "engine/vector/row_kernels.h"

namespace firn::FIRN_ISA {

inline constexpr int kLineReals = kScratchEdge * kQuad;  // of a line of the scratch or of an outbox

/// What passes from stage to stage of one tile.
template <class Real, int D, class Transfer>
struct TileWork {
  static constexpr bool kGradient = !Transfer::moments;
  using Gathered = Records<D, Transfer::affine, kGradient>;  // of the gather and of the scatter alike
  TileStencil<Real, D, kGradient> stencil;
  alignas(64) Quads<Real> record[Gathered::kCount];
  alignas(64) Real v[D][kTileSize];
  alignas(64) Real C[D * D][kTileSize];
  alignas(64) Real tau[D * (D + 1) / 2][kTileSize];
};

constexpr int symmetric_index(int r, int c, int d) {
  const int low = r < c ? r : c, high = r < c ? c : r;
  return low * d - low * (low - 1) / 2 + (high - low);
}

/// The tile's columns, by name.
template <class Real, int D>
struct TileView {
  const ColumnPointers<Real>& columns;

  HWY_INLINE Real* at(Column c, int component = 0) const {
    return columns[static_cast<std::size_t>(c)] + component * kTileSize;
  }
};

/// The largest of everything over the tiles of a block, lane by lane.
template <class Real>
struct LaneMotion {
  Lane<Real> speed2{0}, displacement{0};
  std::int64_t invalid = 0;
};

/// v, C, x and the trial F_E of the first `n` particles of a tile.
template <class Real, int D, class Transfer>
HWY_INLINE void gather_tile(const BlockTask<Real, D>& task, const TileView<Real, D>& tile, int n,
                            const Real* nodes, TileWork<Real, D, Transfer>& work, LaneMotion<Real>& motion) {
  using L = Lane<Real>;
  using Work = TileWork<Real, D, Transfer>;
  using Out = typename Work::Gathered;
  work.stencil.place(tile.at(Column::position), Real(1) / task.h, task.block);
  for (int p = 0; p < n; ++p)
    gather_rows<Real, D, Transfer::affine, Work::kGradient>(work.stencil, nodes, p, work.record);
  // The copies of the first particle that fill a partial tile do as it does: the largest speed is of them
  // all.
  for (int p = n; p < kTileSize; ++p)
    for (Real* quads : work.record) Quad<Real>::load(quads).store(quads + quad_place<Real>(p) * kQuad);

  const L dt(task.dt), inverse_h(Real(1) / task.h), reach(task.h * Real(kMaxCell - 2 * kBlockEdge));
  for (int at = 0; at < kTileSize; at += kLanes<Real>) {
    L q[4], v[D], G[D][D];  // G: dt times the velocity gradient
    load_quads(work.record[0] + at * kQuad, q);
    for (int c = 0; c < D; ++c) v[c] = q[c];
    if constexpr (Transfer::affine)
      for (int d = 0; d < D; ++d) {
        load_quads(work.record[Out::kMoment + d] + at * kQuad, q);
        const L f = L::load(work.stencil.f[d] + at);
        for (int c = 0; c < D; ++c) {
          const L C = (L(4) * inverse_h) * (q[c] - f * v[c]);
          C.store(work.C[c * D + d] + at);
          if constexpr (Transfer::moments) G[c][d] = dt * C;
        }
      }
    if constexpr (!Transfer::moments)
      for (int d = 0; d < D; ++d) {
        load_quads(work.record[Out::kGradient + d] + at * kQuad, q);
        for (int c = 0; c < D; ++c) G[c][d] = (dt * inverse_h) * q[c];
      }

    L extent(0), speed2(0), finite(0);
    for (int c = 0; c < D; ++c) {
      Real* x = tile.at(Column::position, c) + at;
      const L step = dt * v[c], moved = L::load(x) + step;
      moved.store(x);
      v[c].store(work.v[c] + at);
      extent = max(abs(moved), extent);
      motion.displacement = max(abs(step), motion.displacement);
      speed2 = speed2 + v[c] * v[c];
      finite = finite + moved;
    }
    motion.speed2 = max(speed2, motion.speed2);
    for (int j = 0; j < D; ++j) {
      L F[D];
      for (int k = 0; k < D; ++k) F[k] = L::load(tile.at(Column::elastic_deformation, k * D + j) + at);
      for (int i = 0; i < D; ++i) {
        L trial = F[i];
        for (int k = 0; k < D; ++k) trial = trial + G[i][k] * F[k];
        trial.store(tile.at(Column::elastic_deformation, i * D + j) + at);
        finite = finite + trial;
      }
    }
    // Written so that a NaN counts; a maximum would lose it.
    const auto valid = extent + L(0) * (speed2 + finite) <= reach;
    const auto real = L::load(tile.at(Column::volume) + at) > L(0);  // not a copy
    motion.invalid += count((!valid) & real);
  }
}

/// Momentum and the impulse of the stress over `dt`, with `motion` false the impulse alone.
template <class Real, int D, class Transfer, bool motion>
HWY_INLINE void scatter_tile(const BlockTask<Real, D>& task, const TileView<Real, D>& tile, int n,
                             TileWork<Real, D, Transfer>& work, Real* nodes, LineSet& lines) {
  using L = Lane<Real>;
  using Work = TileWork<Real, D, Transfer>;
  using In = typename Work::Gathered;
  work.stencil.place(tile.at(Column::position), Real(1) / task.h, task.block);
  const L h(task.h), impulse(-task.next / task.h), zero(0);
  const auto store = [&](int k, int at, const L(&a)[D]) HWY_ATTR {
    store_quads(a[0], a[1], D == 3 ? a[D - 1] : zero, zero, work.record[k] + at * kQuad);
  };
  for (int at = 0; at < kTileSize; at += kLanes<Real>) {
    const L scale = impulse * L::load(tile.at(Column::volume) + at);
    const L m = motion ? L::load(tile.at(Column::mass) + at) : zero;
    L b[D];
    for (int c = 0; c < D; ++c) b[c] = motion ? m * L::load(work.v[c] + at) : zero;
    for (int d = 0; d < D; ++d) {
      L A[D], T[D];
      for (int c = 0; c < D; ++c) {
        T[c] = scale * L::load(work.tau[symmetric_index(c, d, D)] + at);
        if constexpr (Transfer::affine) {
          A[c] = motion ? (m * h) * L::load(work.C[c * D + d] + at) : zero;
          if constexpr (Transfer::moments) A[c] = A[c] + L(4) * T[c];
          b[c] = b[c] - A[c] * L::load(work.stencil.f[d] + at);
        }
      }
      if constexpr (Transfer::affine) store(In::kMoment + d, at, A);
      if constexpr (!Transfer::moments) store(In::kGradient + d, at, T);
    }
    store_quads(b[0], b[1], D == 3 ? b[D - 1] : m, D == 3 ? m : zero, work.record[0] + at * kQuad);
  }
  constexpr LineSet kTouched = D == 3 ? 0x070707 : 7;  // from a particle's first line on
  for (int p = 0; p < n; ++p) {
    scatter_rows<Real, D, Transfer::affine, Work::kGradient>(work.stencil, work.record, p, nodes);
    lines |= kTouched << work.stencil.first[p] / kLineReals;
  }
}

/// What a pass does with each tile.
enum class Stages { begin, fused, finish, adjust };

/// The columns that pass reads and writes of a tile.
struct TileColumns {
  ColumnSet read, written;
};
constexpr TileColumns columns_of(Stages stages) {
  const ColumnSet state = kMaterialState | ColumnSet{Column::position};
  const ColumnSet motion{Column::velocity, Column::affine};
  const ColumnSet read = state | ColumnSet{Column::mass, Column::volume};
  if (stages == Stages::begin) return {read | motion, state};
  if (stages == Stages::finish) return {read, state | motion | ColumnSet{Column::stress}};
  return {read, state};
}

/// A tile that the block shares with its neighbours is worked on in a copy: the block's own particles first,
/// behind them copies of the first one, without mass and volume.
template <class Real, int D, Stages stages>
class PartialTile {
 public:
  PartialTile(const ColumnPointers<Real>& tile, int first, int last)
      : tile_(tile), first_(first), count_(last - first) {
    Real* next = values_;
    for (int c = 0; c < kColumnCount; ++c) {
      const auto column = static_cast<Column>(c);
      copy_[static_cast<std::size_t>(c)] = nullptr;
      if (tile[static_cast<std::size_t>(c)] == nullptr || !kUsed.has(column)) continue;
      copy_[static_cast<std::size_t>(c)] = next;
      const bool extensive = column == Column::mass || column == Column::volume;
      const Real* from = tile[static_cast<std::size_t>(c)] + first;
      for (int k = 0; k < components(column, D); ++k, from += kTileSize, next += kTileSize) {
        const Lane<Real> rest(extensive ? 0.0 : static_cast<double>(from[0]));
        for (int at = 0; at < kTileSize; at += kLanes<Real>) rest.store(next + at);
        copy_first(from, next, count_);
      }
    }
  }
  void write_back() const {
    for (int c = 0; c < kColumnCount; ++c) {
      const Real* from = copy_[static_cast<std::size_t>(c)];
      const auto column = static_cast<Column>(c);
      if (from == nullptr || !columns_of(stages).written.has(column)) continue;
      Real* to = tile_[static_cast<std::size_t>(c)] + first_;
      for (int k = 0; k < components(column, D); ++k, from += kTileSize, to += kTileSize)
        copy_first(from, to, count_);
    }
  }
  const ColumnPointers<Real>& columns() const { return copy_; }
  int count() const { return count_; }

 private:
  static constexpr ColumnSet kUsed = columns_of(stages).read | columns_of(stages).written;

  const ColumnPointers<Real>& tile_;
  ColumnPointers<Real> copy_;
  int first_, count_;
  alignas(64) Real values_[kUsed.reals(D) * kTileSize];
};

template <class Real, int D, class Transfer, Stages stages>
HWY_INLINE void run_tile(const BlockTask<Real, D>& task, const BatchTask<Real>& batch,
                         const ColumnPointers<Real>& columns, int n, const Real* in, Real* out,
                         TileWork<Real, D, Transfer>& work, LaneMotion<Real>& motion, LineSet& lines) {
  using L = Lane<Real>;
  constexpr bool gathers = stages == Stages::fused || stages == Stages::finish;
  constexpr bool scatters = stages != Stages::finish;
  const TileView<Real, D> tile{columns};
  TickClock clock(batch.ticks);
  if constexpr (gathers) {
    gather_tile<Real, D, Transfer>(task, tile, n, in, work, motion);
    clock.lap(kTransferPart);
  }
  batch.update(batch.model, columns, gathers ? task.dt : Real(0), work.tau[0], *batch.report);
  clock.lap(kMaterialPart);
  if constexpr (stages == Stages::begin)
    for (int at = 0; at < kTileSize; at += kLanes<Real>) {
      for (int c = 0; c < D; ++c) L::load(tile.at(Column::velocity, c) + at).store(work.v[c] + at);
      if constexpr (Transfer::affine)
        for (int c = 0; c < D * D; ++c) L::load(tile.at(Column::affine, c) + at).store(work.C[c] + at);
    }
  if constexpr (stages == Stages::finish)
    for (int at = 0; at < kTileSize; at += kLanes<Real>) {
      for (int c = 0; c < D; ++c) L::load(work.v[c] + at).store(tile.at(Column::velocity, c) + at);
      if constexpr (Transfer::affine)
        for (int c = 0; c < D * D; ++c) L::load(work.C[c] + at).store(tile.at(Column::affine, c) + at);
      if (columns[static_cast<std::size_t>(Column::stress)] != nullptr)
        for (int c = 0; c < D * (D + 1) / 2; ++c)
          L::load(work.tau[c] + at).store(tile.at(Column::stress, c) + at);
    }
  if constexpr (scatters) {
    scatter_tile<Real, D, Transfer, stages != Stages::adjust>(task, tile, n, work, out, lines);
    clock.lap(kTransferPart);
  }
}

/// Eight nodes along the last axis: the last of the block below, the block's four, the first three of the one
/// above.
template <class Real>
HWY_INLINE void load_line(const Real* const* blocks, int line, Real* to) {
  using Q = Quad<Real>;
  constexpr int kEnd = kBlockEdge * kNodeReals;
  const int at = line * kEnd;
  Q::load(blocks[0] + at + kEnd - kNodeReals).store(to);
  const Real* own = blocks[1] + at;
  const Q a = Q::load(own), b = Q::load(own + 4), c = Q::load(own + 8), d = Q::load(own + 12);
  a.store(to + 4), b.store(to + 8), c.store(to + 12), d.store(to + 16);
  const Real* above = blocks[2] + at;
  const Q e = Q::load(above), f = Q::load(above + 4), g = Q::load(above + 8);
  e.store(to + 20), f.store(to + 24), g.store(to + 28);
}

/// Of a scratch line: the first of the three blocks it goes through, and its place in each.
struct ScratchLine {
  int blocks, line;
};
template <int D>
HWY_INLINE ScratchLine scratch_line(int n) {
  if constexpr (D == 2) return {(n + 3) / 4 * 3, (n + 3) % 4};
  const int i = n / kScratchEdge + 3, j = n % kScratchEdge + 3;
  return {(i / 4 * 3 + j / 4) * 3, i % 4 * kBlockEdge + j % 4};
}

template <class Real, int D>
HWY_INLINE void load_scratch(const BlockTask<Real, D>& task, Real* scratch) {
  for_each_bit(task.lines, [&](std::size_t n) HWY_ATTR {
    const ScratchLine from = scratch_line<D>(static_cast<int>(n));
    Real* const line = scratch + n * kLineReals;
    load_line(task.velocities.data() + from.blocks, from.line, line);
    // A row may reach one node beyond its line, without weight; what lies there must be a number.
    Quad<Real>::all(Real(0)).store(line + kLineReals);
  });
}

template <class Real>
HWY_INLINE void copy_lines(LineSet lines, const Real* from, Real* to) {
  for_each_bit(lines, [&](std::size_t n)
                          HWY_ATTR { copy_numbers<kLineReals>(from + n * kLineReals, to + n * kLineReals); });
}

/// The columns of the tile behind this one. The last tile's asks for what is not there, which does nothing.
template <class Real, int D, Stages stages>
HWY_INLINE void prefetch_next(const ColumnPointers<Real>& tile) {
  for (int c = 0; c < kColumnCount; ++c) {
    const auto column = static_cast<Column>(c);
    const Real* const p = tile[static_cast<std::size_t>(c)];
    if (!columns_of(stages).read.has(column) || p == nullptr) continue;
    const auto n = static_cast<std::size_t>(components(column, D)) * kTile;
    prefetch<3>(p + n, n * sizeof(Real));
  }
}

/// What is needed at the end of the block and at the start of the next one is fetched a bit with each tile:
/// the outbox, and of the next block's velocities those that this block does not have.
template <class Real, int D, Stages stages>
class Prefetcher {
 public:
  explicit HWY_INLINE Prefetcher(const BlockTask<Real, D>& task)
      : task_(task), outbox_(task.lines), next_(task.next_lines) {
    std::size_t tiles = 1;
    for (const BatchTask<Real>& batch : task.batches) tiles += (batch.last - batch.first) / kTile;
    at_a_time_ = 1 + std::popcount(outbox_ | next_) / static_cast<int>(tiles);
  }
  HWY_INLINE void fetch_some() {
    for (int k = 0; k < at_a_time_; ++k) {
      if constexpr (stages != Stages::finish)
        if (outbox_ != 0)
          prefetch<2>(task_.outbox + take_line(outbox_) * kLineReals, kLineReals * sizeof(Real));
      if constexpr (stages == Stages::fused || stages == Stages::finish)
        if (next_ != 0) {
          const ScratchLine next = scratch_line<D>(take_line(next_));
          prefetch<2>(task_.next_velocities[static_cast<std::size_t>(next.blocks + 2)] +
                          next.line * kBlockEdge * kQuad,
                      kBlockEdge * kQuad * sizeof(Real));
        }
    }
  }

 private:
  static HWY_INLINE int take_line(LineSet& set) {
    const int n = std::countr_zero(set);
    set &= set - 1;
    return n;
  }

  const BlockTask<Real, D>& task_;
  LineSet outbox_, next_;  // still to be fetched; the outbox's of the last step stand for this one's
  int at_a_time_;
};

template <class Real, int D, class Transfer, Stages stages>
HWY_INLINE void run_tiles(BlockTask<Real, D>& task, const Real* in, Real* out) {
  TileWork<Real, D, Transfer> work;
  LaneMotion<Real> motion;
  LineSet lines = 0;
  Prefetcher<Real, D, stages> prefetcher(task);
  for (const BatchTask<Real>& batch : task.batches)
    for (std::size_t first = batch.first; first < batch.last;) {
      const std::size_t tile_first = first / kTile * kTile, last = std::min(batch.last, tile_first + kTile);
      ColumnPointers<Real> columns;
      for (int c = 0; c < kColumnCount; ++c) {
        Real* const column = batch.columns[static_cast<std::size_t>(c)];
        columns[static_cast<std::size_t>(c)] =
            column == nullptr
                ? nullptr
                : column + tile_first * static_cast<std::size_t>(components(static_cast<Column>(c), D));
      }
      prefetch_next<Real, D, stages>(columns);
      prefetcher.fetch_some();
      if (last - first == kTile) {
        run_tile<Real, D, Transfer, stages>(task, batch, columns, kTileSize, in, out, work, motion, lines);
      } else {
        PartialTile<Real, D, stages> part(columns, static_cast<int>(first - tile_first),
                                          static_cast<int>(last - tile_first));
        run_tile<Real, D, Transfer, stages>(task, batch, part.columns(), part.count(), in, out, work, motion,
                                            lines);
        part.write_back();
      }
      first = last;
    }
  task.motion.max_speed = std::sqrt(static_cast<double>(largest(motion.speed2)));
  task.motion.max_displacement = static_cast<double>(largest(motion.displacement));
  task.motion.invalid = motion.invalid;
  task.touched = lines;
}

template <class Real, int D, class Transfer, Stages stages>
void run_block(BlockTask<Real, D>& task) {
  constexpr int kReals = kOutboxNodes<D> * kQuad;
  // A row of the last line reaches one node beyond it.
  alignas(64) Real in[kReals + kQuad], out[kReals + kQuad];
  if constexpr (stages == Stages::fused || stages == Stages::finish) load_scratch(task, in);
  if constexpr (stages != Stages::finish) fill_zero<kReals>(out);
  if constexpr (stages == Stages::adjust) copy_lines(task.lines, task.outbox, out);
  run_tiles<Real, D, Transfer, stages>(task, in, out);
  if constexpr (stages != Stages::finish) copy_lines(task.touched, out, task.outbox);
}

template <class Real, int D, class Transfer>
TransferKernels<Real, D> transfer_kernels() {
  return {run_block<Real, D, Transfer, Stages::begin>, run_block<Real, D, Transfer, Stages::fused>,
          run_block<Real, D, Transfer, Stages::finish>, run_block<Real, D, Transfer, Stages::adjust>};
}

}  // namespace firn::FIRN_ISA
