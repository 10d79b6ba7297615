// One block of the grid between scatter and gather: adding up what the outboxes hold for it, momentum to
// velocity, and how fast a particle may become.
#pragma once

#include <utility>

#include "engine/vector/tile_stencil.h"

namespace firn::FIRN_ISA {

/// The nodes of a block, of the four along an axis, that the outbox of the block before it, its own and that
/// of the block after it reach, and where that outbox keeps node n: at n + place.
struct Reach {
  int first, last, place;
};
constexpr Reach kReach[3] = {{0, 3, 5}, {0, 4, 1}, {3, 4, -3}};

/// Four nodes along the last axis.
template <class Real>
struct NodeLine {
  Quad<Real> sum[kBlockEdge];

  HWY_INLINE NodeLine() {
    for (auto& q : sum) q = Quad<Real>::all(Real(0));
  }
  /// What the outbox `source` along the axis, whose line this is, holds for them.
  template <int source>
  HWY_INLINE void add(const Real* line) {
    constexpr Reach z = kReach[source];
    for (int n = z.first; n < z.last; ++n) sum[n] = sum[n] + Quad<Real>::load(line + (n + z.place) * kQuad);
  }
  HWY_INLINE void store(Real* nodes) const {
    for (int n = 0; n < kBlockEdge; ++n) sum[n].store(nodes + n * kQuad);
  }
};
#if HWY_TARGET <= HWY_AVX3
template <>
struct NodeLine<float> {
  using Tag = hn::FixedTag<float, 16>;
  hn::Vec<Tag> sum = hn::Zero(Tag());

  template <int source>
  HWY_INLINE void add(const float* line) {
    const auto three = hn::FirstN(Tag(), 3 * kQuad);
    const float* const p = line + kReach[source].place * kQuad;
    if constexpr (source == 0) sum = hn::Add(sum, hn::MaskedLoad(three, Tag(), p));
    if constexpr (source == 1) sum = hn::Add(sum, hn::LoadU(Tag(), p));
    if constexpr (source == 2) sum = hn::Add(sum, hn::MaskedLoad(hn::Not(three), Tag(), p));
  }
  HWY_INLINE void store(float* nodes) const { hn::StoreU(sum, Tag(), nodes); }
};
#endif

// How the outbox that is `source` of the 3^D around a block reaches it along the axes before the last, and
// where it keeps the line (i, j) of the block; in 2D there is no second axis.
template <int D>
constexpr Reach reach_x(int source) {
  return kReach[D == 3 ? source / 9 : source / 3];
}
template <int D>
constexpr Reach reach_y(int source) {
  return D == 3 ? kReach[source / 3 % 3] : Reach{0, 1, 0};
}
template <int D>
constexpr int outbox_line(Reach x, Reach y, int i, int j) {
  return D == 3 ? (i + x.place) * kScratchEdge + j + y.place : i + x.place;
}
template <int D>
constexpr LineSet needed_lines(int source) {
  const Reach x = reach_x<D>(source), y = reach_y<D>(source);
  LineSet out = 0;
  for (int i = x.first; i < x.last; ++i)
    for (int j = y.first; j < y.last; ++j) out |= LineSet{1} << outbox_line<D>(x, y, i, j);
  return out;
}

/// What a block needs of an outbox when that is `source` of the 3^D around it: calls f with the number of
/// each of the block's lines and the line of the outbox for it, zeros where that holds nothing.
template <class Real, int D, int source, class F>
HWY_INLINE void for_each_line(const OutboxView<Real>& outbox, F&& f) {
  constexpr int kLine = kScratchEdge * kQuad, kLines = D == 3 ? kBlockEdge : 1;  // of the block, in a plane
  constexpr Reach x = reach_x<D>(source), y = reach_y<D>(source);
  constexpr LineSet needed = needed_lines<D>(source);
  alignas(64) static constexpr Real kZeros[kLine] = {};
  if ((outbox.lines & needed) == 0) return;
  for (int i = x.first; i < x.last; ++i)
    for (int j = y.first; j < y.last; ++j) {
      const int n = outbox_line<D>(x, y, i, j);
      f(i * kLines + j, outbox.lines >> n & 1 ? outbox.nodes + n * kLine : kZeros);
    }
}

/// The momentum of each node divided by its mass. A weight so small that the mass underflows to zero carries
/// a momentum below rounding, which is left as it is.
template <class Real, int D>
HWY_INLINE bool to_velocity(Real* nodes) {
  using L = Lane<Real>;
  L heaviest(0);
  for (std::size_t n = 0; n < kBlockNodes<D>; n += kLanes<Real>, nodes += kLanes<Real> * kQuad) {
    L q[4];
    load_quads(nodes, q);
    const L divisor = select(q[D] > L(0), q[D], L(1));
    for (int d = 0; d < D; ++d) q[d] = q[d] / divisor;
    heaviest = max(q[D], heaviest);
    store_quads(q[0], q[1], q[2], q[3], nodes);
  }
  return largest(heaviest) > Real(0);
}

template <class Real, int D, int... source>
HWY_INLINE bool collect_from(const OutboxViews<Real, D>& outboxes, const OutboxViews<Real, D>& next,
                             Real* nodes, std::integer_sequence<int, source...>) {
  // What the next block needs and this one does not: the third of the outboxes along the last axis.
  const auto fetch = [](int, const Real* line) { prefetch<3>(line, kScratchEdge * kQuad * sizeof(Real)); };
  ((source % 3 == 2 ? for_each_line<Real, D, source>(next[source], fetch) : void()), ...);

  if (((outboxes[source].lines & needed_lines<D>(source)) | ...) == 0) return false;
  NodeLine<Real> lines[kBlockNodes<D> / kBlockEdge];
  (for_each_line<Real, D, source>(
       outboxes[source], [&](int k, const Real* line) HWY_ATTR { lines[k].template add<source % 3>(line); }),
   ...);
  Real* out = nodes;
  for (const NodeLine<Real>& line : lines) {
    line.store(out);
    out += kBlockEdge * kQuad;
  }
  return to_velocity<Real, D>(nodes);
}

/// `lightest`: the least mass of a particle, kg.
template <class Real, int D>
SpeedBound speed_bound(const Real* nodes, Real lightest) {
  using L = Lane<Real>;
  const L share(Real(kNeighbours<D>) / lightest);
  L heavy(0), light(0), finite(0);
  for (std::size_t n = 0; n < kBlockNodes<D>; n += kLanes<Real>, nodes += kLanes<Real> * kQuad) {
    L q[4];
    load_quads(nodes, q);
    const L part = share * q[D];
    L speed(0);
    for (int d = 0; d < D; ++d) {
      const L v = select(part > L(0), q[d], L(0));
      speed = max(abs(v), speed);
      finite = finite + L(0) * v;  // a maximum would lose a NaN
    }
    const auto is_heavy = part >= L(1);
    heavy = max(select(is_heavy, speed, L(0)), heavy);
    light = max(select(is_heavy, L(0), part * speed), light);
  }
  if (any(!(finite == L(0)))) return {std::numeric_limits<double>::infinity(), 0};
  return {static_cast<double>(largest(heavy)), static_cast<double>(largest(light))};
}

template <class Real, int D>
bool collect(const OutboxViews<Real, D>& outboxes, const OutboxViews<Real, D>& next, Real* nodes) {
  return collect_from<Real, D>(outboxes, next, nodes, std::make_integer_sequence<int, kNeighbours<D>>());
}

template <class Real, int D>
GridKernels<Real, D> grid_kernels() {
  return {collect<Real, D>, speed_bound<Real, D>};
}

}  // namespace firn::FIRN_ISA
