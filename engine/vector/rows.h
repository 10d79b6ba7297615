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
  /// p[k] on all four numbers of node k.
  static HWY_INLINE QuadRow by_node(const R* p) {
    return {Quad<R>::all(p[0]), Quad<R>::all(p[1]), Quad<R>::all(p[2])};
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

#if HWY_TARGET <= HWY_AVX3
/// One register of 16 floats.
struct FullRow {
  using Tag = hn::FixedTag<float, 16>;
  hn::Vec<Tag> v;

  static HWY_INLINE FullRow load(const float* p) { return {hn::LoadU(Tag(), p)}; }
  HWY_INLINE void store(float* p) const { hn::StoreU(v, Tag(), p); }
  static HWY_INLINE FullRow all(float x) { return {hn::Set(Tag(), x)}; }
  static HWY_INLINE FullRow repeated(const float* p) { return {hn::LoadDup128(Tag(), p)}; }
  static HWY_INLINE FullRow by_node(const float* p) {
    // Within node k, take number k of the quad.
    return {
        hn::Vec<Tag>{_mm512_permutevar_ps(_mm512_broadcast_f32x4(_mm_load_ps(p)),
                                          _mm512_set_epi32(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0))}};
  }
  HWY_INLINE Quad<float> node(int k) const {
    const __m512 x = v.raw;
    const __m128 out = k == 0   ? _mm512_castps512_ps128(x)
                       : k == 1 ? _mm512_extractf32x4_ps(x, 1)
                                : _mm512_extractf32x4_ps(x, 2);
    return {{hn::Vec<Quad<float>::Tag>{out}}};
  }
  HWY_INLINE Quad<float> sum() const { return (node(0) + node(1)) + node(2); }
  HWY_INLINE Quad<float> last_less_first() const { return node(2) - node(0); }

  friend HWY_INLINE FullRow operator+(FullRow a, FullRow b) { return {hn::Add(a.v, b.v)}; }
  friend HWY_INLINE FullRow operator-(FullRow a, FullRow b) { return {hn::Sub(a.v, b.v)}; }
  friend HWY_INLINE FullRow operator*(FullRow a, FullRow b) { return {hn::Mul(a.v, b.v)}; }
  friend HWY_INLINE FullRow fma(FullRow a, FullRow b, FullRow c) { return {hn::MulAdd(a.v, b.v, c.v)}; }
};
template <class R>
using Row = std::conditional_t<sizeof(R) == 4, FullRow, QuadRow<R>>;
#else
template <class R>
using Row = QuadRow<R>;
#endif

/// -1, 0, 1 by node: the offset from the middle one.
template <class R>
HWY_INLINE Row<R> node_offsets() {
  alignas(64) static constexpr R k[4] = {-1, 0, 1, 0};
  return Row<R>::by_node(k);
}

}  // namespace firn::FIRN_ISA
