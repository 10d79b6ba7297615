// A row of the scratch: three neighbouring nodes along the last axis, four numbers each (velocity or
// momentum, and mass). The transfers work on rows: a particle touches nine of them in 3D and three in 2D.
//
// In one register of 16 floats the fourth node's place is along for the ride: its weight is zero.
#pragma once

#include "engine/vector/wide.h"

namespace firn::FIRN_ISA {

inline constexpr int kQuad = 4;  // numbers of a node

/// Four numbers: one node.
template <class R>
struct Quad {
  // SSE4 has no register of four doubles.
  static constexpr int kParts = static_cast<int>(sizeof(R)) * kQuad > HWY_MAX_BYTES ? 2 : 1;
  using Tag = hn::CappedTag<R, kQuad / kParts>;
  hn::Vec<Tag> v[kParts];

  static HWY_INLINE Quad load(const R* p) {
    Quad out;
    for (int i = 0; i < kParts; ++i) out.v[i] = hn::LoadU(Tag(), p + i * 2);
    return out;
  }
  HWY_INLINE void store(R* p) const {
    for (int i = 0; i < kParts; ++i) hn::StoreU(v[i], Tag(), p + i * 2);
  }
  static HWY_INLINE Quad all(R x) {
    Quad out;
    for (int i = 0; i < kParts; ++i) out.v[i] = hn::Set(Tag(), x);
    return out;
  }
  friend HWY_INLINE Quad operator+(Quad a, Quad b) {
    for (int i = 0; i < kParts; ++i) a.v[i] = hn::Add(a.v[i], b.v[i]);
    return a;
  }
  friend HWY_INLINE Quad operator-(Quad a, Quad b) {
    for (int i = 0; i < kParts; ++i) a.v[i] = hn::Sub(a.v[i], b.v[i]);
    return a;
  }
  friend HWY_INLINE Quad operator*(Quad a, Quad b) {
    for (int i = 0; i < kParts; ++i) a.v[i] = hn::Mul(a.v[i], b.v[i]);
    return a;
  }
  /// a b + c
  friend HWY_INLINE Quad fma(Quad a, Quad b, Quad c) {
    for (int i = 0; i < kParts; ++i) c.v[i] = hn::MulAdd(a.v[i], b.v[i], c.v[i]);
    return c;
  }
};

/// Three Quads.
template <class R>
struct QuadRow {
  Quad<R> q[3];

  static HWY_INLINE QuadRow load(const R* p) {
    return {Quad<R>::load(p), Quad<R>::load(p + 4), Quad<R>::load(p + 8)};
  }
  HWY_INLINE void store(R* p) const {
    for (int i = 0; i < 3; ++i) q[i].store(p + i * kQuad);
  }
  static HWY_INLINE QuadRow all(R x) {
    const Quad<R> one = Quad<R>::all(x);
    return {one, one, one};
  }
  /// The same four numbers on each node.
  static HWY_INLINE QuadRow repeated(const R* p) {
    const Quad<R> one = Quad<R>::load(p);
    return {one, one, one};
  }
  /// p[k stride] on all four numbers of node k.
  static HWY_INLINE QuadRow by_node(const R* p, int stride) {
    return {Quad<R>::all(p[0]), Quad<R>::all(p[stride]), Quad<R>::all(p[2 * stride])};
  }
  HWY_INLINE Quad<R> sum() const { return q[0] + q[1] + q[2]; }
  HWY_INLINE Quad<R> last_less_first() const { return q[2] - q[0]; }

  friend HWY_INLINE QuadRow operator+(QuadRow a, QuadRow b) {
    return {a.q[0] + b.q[0], a.q[1] + b.q[1], a.q[2] + b.q[2]};
  }
  friend HWY_INLINE QuadRow operator-(QuadRow a, QuadRow b) {
    return {a.q[0] - b.q[0], a.q[1] - b.q[1], a.q[2] - b.q[2]};
  }
  friend HWY_INLINE QuadRow operator*(QuadRow a, QuadRow b) {
    return {a.q[0] * b.q[0], a.q[1] * b.q[1], a.q[2] * b.q[2]};
  }
  friend HWY_INLINE QuadRow fma(QuadRow a, QuadRow b, QuadRow c) {
    return {fma(a.q[0], b.q[0], c.q[0]), fma(a.q[1], b.q[1], c.q[1]), fma(a.q[2], b.q[2], c.q[2])};
  }
};

#if HWY_TARGET <= HWY_AVX2
/// Two nodes in a register of 8 floats, the third in one of 4.
struct PairRow {
  using Pair = hn::FixedTag<float, 8>;
  using One = hn::FixedTag<float, 4>;
  hn::Vec<Pair> a;
  hn::Vec<One> b;

  static HWY_INLINE PairRow load(const float* p) { return {hn::LoadU(Pair(), p), hn::LoadU(One(), p + 8)}; }
  HWY_INLINE void store(float* p) const {
    hn::StoreU(a, Pair(), p);
    hn::StoreU(b, One(), p + 8);
  }
  static HWY_INLINE PairRow all(float x) {
    const auto v = hn::Set(Pair(), x);
    return {v, hn::LowerHalf(One(), v)};
  }
  static HWY_INLINE PairRow repeated(const float* p) {
    const auto v = hn::LoadDup128(Pair(), p);
    return {v, hn::LowerHalf(One(), v)};
  }
  static HWY_INLINE PairRow by_node(const float* p, int stride) {
    return {hn::ConcatUpperLower(Pair(), hn::Set(Pair(), p[stride]), hn::Set(Pair(), p[0])),
            hn::Set(One(), p[2 * stride])};
  }
  HWY_INLINE Quad<float> sum() const {
    return {{hn::Add(hn::Add(hn::LowerHalf(One(), a), hn::UpperHalf(One(), a)), b)}};
  }
  HWY_INLINE Quad<float> last_less_first() const { return {{hn::Sub(b, hn::LowerHalf(One(), a))}}; }

  friend HWY_INLINE PairRow operator+(PairRow x, PairRow y) { return {hn::Add(x.a, y.a), hn::Add(x.b, y.b)}; }
  friend HWY_INLINE PairRow operator-(PairRow x, PairRow y) { return {hn::Sub(x.a, y.a), hn::Sub(x.b, y.b)}; }
  friend HWY_INLINE PairRow operator*(PairRow x, PairRow y) { return {hn::Mul(x.a, y.a), hn::Mul(x.b, y.b)}; }
  friend HWY_INLINE PairRow fma(PairRow x, PairRow y, PairRow z) {
    return {hn::MulAdd(x.a, y.a, z.a), hn::MulAdd(x.b, y.b, z.b)};
  }
};
template <class R>
using Row = std::conditional_t<sizeof(R) == 4, PairRow, QuadRow<R>>;
#else
template <class R>
using Row = QuadRow<R>;
#endif

/// -1, 0, 1 by node: the offset from the middle one.
template <class R>
HWY_INLINE Row<R> node_offsets() {
  alignas(64) static constexpr R k[4] = {-1, 0, 1, 0};
  return Row<R>::by_node(k, 1);
}

}  // namespace firn::FIRN_ISA
