// The kernels of one tile of particles: where each begins in the scratch of its block, and its weights.
#pragma once

#include "engine/particles/tile.h"
#include "engine/vector/kernels.h"
#include "engine/vector/rows.h"

namespace firn::FIRN_ISA {

/// One register of particles.
template <class Real>
using Lane = Wide<Real, 1>;
template <class Real>
inline constexpr int kLanes = Lane<Real>::kLanes;
inline constexpr int kTileSize = static_cast<int>(kTile);
inline constexpr int kScratchEdge = 2 * kBlockEdge;

/// A quad for each particle, in the order that takes the fewest shuffles from lanes (quad_place).
template <class Real>
using Quads = Real[kTileSize * kQuad];

/// Which quad is particle p's. Within blocks of 128 bits, where floats are transposed, all of a register's
/// blocks go side by side: first the registers' particles 0, 4, 8, 12, then 1, 5, ...
template <class Real>
HWY_INLINE constexpr int quad_place(int p) {
  constexpr int kBlocks = kLanes<Real> / 4;
  if constexpr (sizeof(Real) == 8 || kBlocks == 1) return p;
  return p / kLanes<Real> * kLanes<Real> + p % 4 * kBlocks + p / 4 % kBlocks;
}

HWY_INLINE void store_quads(const Lane<float>& a, const Lane<float>& b, const Lane<float>& c,
                            const Lane<float>& d, float* out) {
  const Lane<float>::Tag tag;
  const auto ac = hn::InterleaveLower(tag, a.v[0], c.v[0]), bd = hn::InterleaveLower(tag, b.v[0], d.v[0]);
  const auto ac2 = hn::InterleaveUpper(tag, a.v[0], c.v[0]), bd2 = hn::InterleaveUpper(tag, b.v[0], d.v[0]);
  hn::Store(hn::InterleaveLower(tag, ac, bd), tag, out);
  hn::Store(hn::InterleaveUpper(tag, ac, bd), tag, out + kLanes<float>);
  hn::Store(hn::InterleaveLower(tag, ac2, bd2), tag, out + 2 * kLanes<float>);
  hn::Store(hn::InterleaveUpper(tag, ac2, bd2), tag, out + 3 * kLanes<float>);
}
HWY_INLINE void load_quads(const float* in, Lane<float> (&out)[4]) {
  const Lane<float>::Tag tag;
  const hn::ScalableTag<double> two;  // numbers at a time
  const auto q0 = hn::Load(tag, in), q1 = hn::Load(tag, in + kLanes<float>);
  const auto q2 = hn::Load(tag, in + 2 * kLanes<float>), q3 = hn::Load(tag, in + 3 * kLanes<float>);
  const auto ab = hn::BitCast(two, hn::InterleaveLower(tag, q0, q1)),
             cd = hn::BitCast(two, hn::InterleaveUpper(tag, q0, q1)),
             ab2 = hn::BitCast(two, hn::InterleaveLower(tag, q2, q3)),
             cd2 = hn::BitCast(two, hn::InterleaveUpper(tag, q2, q3));
  out[0].v[0] = hn::BitCast(tag, hn::InterleaveLower(two, ab, ab2));
  out[1].v[0] = hn::BitCast(tag, hn::InterleaveUpper(two, ab, ab2));
  out[2].v[0] = hn::BitCast(tag, hn::InterleaveLower(two, cd, cd2));
  out[3].v[0] = hn::BitCast(tag, hn::InterleaveUpper(two, cd, cd2));
}
HWY_INLINE void store_quads(const Lane<double>& a, const Lane<double>& b, const Lane<double>& c,
                            const Lane<double>& d, double* out) {
  hn::StoreInterleaved4(a.v[0], b.v[0], c.v[0], d.v[0], Lane<double>::Tag(), out);
}
HWY_INLINE void load_quads(const double* in, Lane<double> (&out)[4]) {
  hn::LoadInterleaved4(Lane<double>::Tag(), in, out[0].v[0], out[1].v[0], out[2].v[0], out[3].v[0]);
}

template <class Real, int D, bool kGradient>
struct TileStencil {
  using Weights = Real[3][kTileSize];
  alignas(64) Weights w[D];                   // of the three nodes along each axis
  alignas(64) Weights dw[kGradient ? D : 1];  // their derivatives by x/h
  alignas(64) std::int32_t first[kTileSize];  // of the scratch's numbers: the particle's first node
  alignas(64) Real f[D][kTileSize];           // x/h less the middle node, in [-1/2, 1/2)

  /// `position`: the tile's column. Particles that are not where their block's scratch reaches (not finite,
  /// say) get a place in it all the same; the pass counts them as invalid.
  HWY_INLINE void place(const Real* position, Real inverse_h, const BlockCoord<D>& block) {
    using L = Lane<Real>;
    for (int at = 0; at < kTileSize; at += kLanes<Real>) {
      L index(0);
      for (int d = 0; d < D; ++d) {
        const L cell = L::load(position + d * kTileSize + at) * L(inverse_h);
        const L base = floor(cell - L(0.5));
        const L local = base - L(block[static_cast<std::size_t>(d)] * kBlockEdge - 1);
        index = index * L(kScratchEdge) + min(max(local, L(0)), L(kScratchEdge - 3));
        const L x = cell - base - L(1);
        x.store(f[d] + at);
        const L half(0.5), low = half - x, high = half + x;
        (half * low * low).store(w[d][0] + at);
        (L(0.75) - x * x).store(w[d][1] + at);
        (half * high * high).store(w[d][2] + at);
        if constexpr (kGradient) {
          (-low).store(dw[d][0] + at);
          (L(-2) * x).store(dw[d][1] + at);
          high.store(dw[d][2] + at);
        }
      }
      const auto numbers = index * L(kQuad);
      if constexpr (sizeof(Real) == 4) {
        const hn::RebindToSigned<typename L::Tag> tag;
        hn::Store(hn::ConvertTo(tag, numbers.v[0]), tag, first + at);
      } else {
        const hn::Rebind<std::int32_t, typename L::Tag> tag;
        hn::Store(hn::DemoteTo(tag, numbers.v[0]), tag, first + at);
      }
    }
  }
};

}  // namespace firn::FIRN_ISA
