// The return map and the stress of a tile: the material's own `update`, on lanes.
#pragma once

#include "engine/vector/tile_stencil.h"
#include "materials/material_point.h"

namespace firn::FIRN_ISA {

/// Registers side by side: with 32 of them two chains of work fit, with 16 they spill.
#if HWY_TARGET <= HWY_AVX3
inline constexpr int kSideBySide = 2;
#else
inline constexpr int kSideBySide = 1;
#endif

template <class Real>
using MaterialLane =
    Wide<Real, (kTileSize / kLanes<Real> < kSideBySide ? kTileSize / kLanes<Real> : kSideBySide)>;

template <class Value, class Real>
HWY_INLINE void load_value(Value& value, const Real* p) {
  using L = MaterialLane<Real>;
  if constexpr (std::is_same_v<Value, L>) {
    value = L::load(p);
  } else {
    constexpr int n = sizeof(Value) / sizeof(L);
    L* out = reinterpret_cast<L*>(&value);
    for (int c = 0; c < n; ++c) out[c] = L::load(p + c * kTileSize);
  }
}
template <class Value, class Real>
HWY_INLINE void store_value(const Value& value, Real* p) {
  using L = MaterialLane<Real>;
  if constexpr (std::is_same_v<Value, L>) {
    value.store(p);
  } else {
    constexpr int n = sizeof(Value) / sizeof(L);
    const L* in = reinterpret_cast<const L*>(&value);
    for (int c = 0; c < n; ++c) in[c].store(p + c * kTileSize);
  }
}

template <class Model, class Real, int D>
__attribute__((flatten)) void update_tile(const void* model_pointer, const ColumnPointers<Real>& tile,
                                          Real dt, Real* tau, MaterialReport& report) {
  using L = MaterialLane<Real>;
  const Model& model = *static_cast<const Model*>(model_pointer);
  L dissipated(0), modulus(0);
  for (int at = 0; at < kTileSize; at += L::kLanes) {
    typename Model::template Point<L, D> point;
    point.visit([&](auto column, auto& value)
                    HWY_ATTR { load_value(value, tile[static_cast<std::size_t>(column())] + at); });
    const Response<L, D> response = model.update(point, L(static_cast<double>(dt)));
    point.visit([&](auto column, const auto& value)
                    HWY_ATTR { store_value(value, tile[static_cast<std::size_t>(column())] + at); });
    L sum = response.wave_modulus;
    for (int r = 0, k = 0; r < D; ++r)
      for (int c = r; c < D; ++c, ++k) {
        response.tau(r, c).store(tau + k * kTileSize + at);
        sum = sum + response.tau(r, c) * response.tau(r, c);
      }
    const L volume = L::load(tile[static_cast<std::size_t>(Column::volume)] + at);
    const auto real = volume > L(0);  // not a copy that fills a partial tile
    dissipated = dissipated + response.dissipated * volume;
    modulus = max(response.wave_modulus, modulus);
    report.capped += count((response.capped > L(0)) & real);
    // Written so that a NaN counts.
    report.invalid += count((!(L(0) * sum <= L(0))) & real);
  }
  report.max_wave_modulus = std::max(report.max_wave_modulus, static_cast<double>(largest(modulus)));
  alignas(64) Real lanes[L::kLanes];
  dissipated.store(lanes);
  for (const Real x : lanes) report.dissipated += static_cast<double>(x);
}

}  // namespace firn::FIRN_ISA
