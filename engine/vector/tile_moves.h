// Moving a column's particles to new places. What becomes one register of particles comes from few registers,
// for a sort moves neighbours together: each of these is loaded whole and dealt out.
#pragma once

#include <bit>

#include "engine/particles/move_tiles.h"
#include "engine/vector/tile_stencil.h"

namespace firn::FIRN_ISA {

#if HWY_TARGET <= HWY_AVX3

// Of lanes that are equal, the first: a bit each. That all are known at once keeps the loop over them from
// waiting for its own comparisons.
template <class V>
HWY_INLINE unsigned firsts(V v) {
  if constexpr (sizeof(hn::TFromV<V>) == 4)
    return _mm512_testn_epi32_mask(_mm512_conflict_epi32(v.raw), _mm512_set1_epi32(-1));
  else
    return _mm512_testn_epi64_mask(_mm512_conflict_epi64(v.raw), _mm512_set1_epi64(-1));
}

template <int width, class Real>
HWY_INLINE void move_register(const Real* from, Real* to, const std::uint32_t* source) {
  using Tag = typename Lane<Real>::Tag;
  using Index = hn::RebindToUnsigned<Tag>;
  constexpr std::uint32_t kMask = kLanes<Real> - 1;
  const auto wanted = [&] {
    if constexpr (sizeof(Real) == 4)
      return hn::LoadU(Index(), source);
    else
      return hn::PromoteTo(Index(), hn::LoadU(hn::Rebind<std::uint32_t, Index>(), source));
  }();
  const auto lanes = hn::IndicesFromVec(Tag(), hn::And(wanted, hn::Set(Index(), kMask)));
  const auto group = hn::AndNot(hn::Set(Index(), kMask), wanted);
  hn::Vec<Tag> out[width];
  for (auto& v : out) v = hn::Zero(Tag());
  for (unsigned rest = firsts(group); rest != 0; rest &= rest - 1) {
    const std::uint32_t first = source[std::countr_zero(rest)] & ~kMask;
    const auto here = hn::RebindMask(Tag(), hn::Eq(group, hn::Set(Index(), first)));
    const Real* in = from + tile_index(first, 0, width);
    for (int c = 0; c < width; ++c)
      out[c] = hn::IfThenElse(here, hn::TableLookupLanes(hn::Load(Tag(), in + c * kTileSize), lanes), out[c]);
  }
  for (int c = 0; c < width; ++c) hn::Store(out[c], Tag(), to + c * kTileSize);
}

template <int width, class Real>
void move_width(const Real* from, Real* to, const std::uint32_t* source, std::size_t tiles) {
  for (std::size_t tile = 0; tile < tiles; ++tile, source += kTile, to += width * kTile)
    for (int at = 0; at < kTileSize; at += kLanes<Real>) move_register<width>(from, to + at, source + at);
}

#else

template <int width, class Real>
void move_width(const Real* from, Real* to, const std::uint32_t* source, std::size_t tiles) {
  for (std::size_t tile = 0; tile < tiles; ++tile, source += kTile, to += width * kTile)
    for (int i = 0; i < kTileSize; ++i) {
      const Real* in = from + tile_index(source[i], 0, width);
      for (int c = 0; c < width; ++c) to[c * kTileSize + i] = in[c * kTileSize];
    }
}

#endif

template <class Real, int D>
void move_tiles(const Real* from, Real* to, const std::uint32_t* source, std::size_t tiles, int width) {
  if (width == 1)
    move_width<1>(from, to, source, tiles);
  else if (width == D)
    move_width<D>(from, to, source, tiles);
  else if (width == D * D)
    move_width<D * D>(from, to, source, tiles);
  else
    move_width<D*(D + 1) / 2>(from, to, source, tiles);
}

}  // namespace firn::FIRN_ISA
