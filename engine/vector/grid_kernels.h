// One block of the grid between scatter and gather: adding up what the outboxes hold for it, momentum to
// velocity, and how fast a particle may become.
#pragma once

#include "engine/vector/tile_stencil.h"

namespace firn::FIRN_ISA {

/// Four nodes along the last axis, added up from the three outboxes that reach them there: what is for the
/// block above stands at 0, the outbox's own nodes at 1 to 4, what is for the block below at 5 to 7.
template <class Real>
struct NodeLine {
  Quad<Real> sum[kBlockEdge];

  HWY_INLINE NodeLine() {
    for (auto& q : sum) q = Quad<Real>::all(Real(0));
  }
  HWY_INLINE void add(const Real* lower, const Real* own, const Real* upper) {
    for (int n = 0; n < 3; ++n) sum[n] = sum[n] + Quad<Real>::load(lower + (5 + n) * kQuad);
    for (int n = 0; n < 4; ++n) sum[n] = sum[n] + Quad<Real>::load(own + (1 + n) * kQuad);
    sum[3] = sum[3] + Quad<Real>::load(upper);
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

  HWY_INLINE void add(const float* lower, const float* own, const float* upper) {
    const auto three = hn::FirstN(Tag(), 3 * kQuad);
    sum = hn::Add(sum, hn::LoadU(Tag(), own + kQuad));
    sum = hn::Add(sum, hn::MaskedLoad(three, Tag(), lower + 5 * kQuad));
    sum = hn::Add(sum, hn::MaskedLoad(hn::Not(three), Tag(), upper - 3 * kQuad));
  }
  HWY_INLINE void store(float* nodes) const { hn::StoreU(sum, Tag(), nodes); }
};
#endif

/// The two outboxes along an axis that reach node `n` of the block, and where they keep it.
struct Reach {
  int source[2], place[2];
};
HWY_INLINE Reach reach(int n) {
  return n < 3 ? Reach{{0, 1}, {5 + n, 1 + n}} : Reach{{1, 2}, {1 + n, 0}};
}

/// A line of an outbox, two cache lines in float.
template <class Real>
HWY_INLINE void prefetch_line(const Real* line) {
  prefetch<3>(line, 2 * kBlockEdge * kQuad * sizeof(Real));
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

template <class Real, int D>
bool collect(const OutboxPointers<Real, D>& outboxes, const OutboxPointers<Real, D>& next, Real* nodes) {
  constexpr int kEdge = 2 * kBlockEdge, kLine = kEdge * kQuad;
  Real* line = nodes;
  for (int i = 0; i < kBlockEdge; ++i) {
    const Reach x = reach(i);
    for (int j = 0; j < (D == 3 ? kBlockEdge : 1); ++j, line += kBlockEdge * kQuad) {
      const Reach y = D == 3 ? reach(j) : Reach{{0, 0}, {0, 0}};
      NodeLine<Real> sum;
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < (D == 3 ? 2 : 1); ++b) {
          const int first = D == 3 ? (x.source[a] * 3 + y.source[b]) * 3 : x.source[a] * 3;
          const int at = (D == 3 ? x.place[a] * kEdge + y.place[b] : x.place[a]) * kLine;
          const Real* const* box = outboxes.data() + first;
          sum.add(box[0] + at, box[1] + at, box[2] + at);
          prefetch_line(next[static_cast<std::size_t>(first + 2)] + at);
        }
      sum.store(line);
    }
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
GridKernels<Real, D> grid_kernels() {
  return {collect<Real, D>, speed_bound<Real, D>};
}

}  // namespace firn::FIRN_ISA
