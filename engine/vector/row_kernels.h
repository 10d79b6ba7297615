// Gather and scatter of single particles, row by row. Offsets count nodes from the particle's middle node;
// the shift to the particle's own place is left to the lanes (transfer_kernels.h), sixteen particles at a
// time.
//
// Gathered per particle, a Quad each: v = sum w v_i, then along each axis the moment sum w v_i (offset), the
// gradient sum dw v_i, or both. Scattered: b + A offset with weights w, and T with the gradients dw.
#pragma once

#include "engine/vector/tile_stencil.h"

namespace firn::FIRN_ISA {

/// Which Quads go with a particle: the value, D moments when `moments`, D gradients when `gradient`.
template <int D, bool moments, bool gradient>
struct Records {
  static constexpr int kMoment = 1;
  static constexpr int kGradient = 1 + (moments ? D : 0);
  static constexpr int kCount = kGradient + (gradient ? D : 0);
};

template <class Real, int D, bool moments, bool gradient>
HWY_INLINE void gather_rows(const TileStencil<Real, D, gradient>& stencil, const Real* nodes, int particle,
                            Quads<Real>* out) {
  using R = Row<Real>;
  using Out = Records<D, moments, gradient>;
  constexpr int kLine = kScratchEdge * kQuad;
  const int at = quad_place<Real>(particle) * kQuad;
  const Real* first = nodes + stencil.first[particle];
  const auto weight = [&](int d, int n) HWY_ATTR { return R::all(stencil.w[d][n][particle]); };
  const auto slope = [&](int d, int n) HWY_ATTR { return R::all(stencil.dw[d][n][particle]); };
  const R w_last = R::by_node(&stencil.w[D - 1][0][particle], kTileSize);

  if constexpr (D == 3) {
    R s[3], y[3], gy[3];
    for (int i = 0; i < 3; ++i) {
      const Real* line = first + i * kScratchEdge * kLine;
      const R r0 = R::load(line), r1 = R::load(line + kLine), r2 = R::load(line + 2 * kLine);
      const R low = weight(1, 0) * r0, high = weight(1, 2) * r2;
      s[i] = fma(weight(1, 1), r1, low + high);
      if constexpr (moments) y[i] = high - low;
      if constexpr (gradient) gy[i] = fma(slope(1, 0), r0, fma(slope(1, 1), r1, slope(1, 2) * r2));
    }
    const R low = weight(0, 0) * s[0], high = weight(0, 2) * s[2];
    const R sum = w_last * fma(weight(0, 1), s[1], low + high);
    sum.sum().store(out[0] + at);
    if constexpr (moments) {
      (w_last * (high - low)).sum().store(out[Out::kMoment] + at);
      const R along_y = fma(weight(0, 0), y[0], fma(weight(0, 1), y[1], weight(0, 2) * y[2]));
      (w_last * along_y).sum().store(out[Out::kMoment + 1] + at);
      sum.last_less_first().store(out[Out::kMoment + 2] + at);
    }
    if constexpr (gradient) {
      const R gx = fma(slope(0, 0), s[0], fma(slope(0, 1), s[1], slope(0, 2) * s[2]));
      (w_last * gx).sum().store(out[Out::kGradient] + at);
      const R along_y = fma(weight(0, 0), gy[0], fma(weight(0, 1), gy[1], weight(0, 2) * gy[2]));
      (w_last * along_y).sum().store(out[Out::kGradient + 1] + at);
      const R slope_last = R::by_node(&stencil.dw[2][0][particle], kTileSize);
      (slope_last * fma(weight(0, 1), s[1], low + high)).sum().store(out[Out::kGradient + 2] + at);
    }
  } else {
    const R r0 = R::load(first), r1 = R::load(first + kLine), r2 = R::load(first + 2 * kLine);
    const R low = weight(0, 0) * r0, high = weight(0, 2) * r2;
    const R across = fma(weight(0, 1), r1, low + high), sum = w_last * across;
    sum.sum().store(out[0] + at);
    if constexpr (moments) {
      (w_last * (high - low)).sum().store(out[Out::kMoment] + at);
      sum.last_less_first().store(out[Out::kMoment + 1] + at);
    }
    if constexpr (gradient) {
      const R gx = fma(slope(0, 0), r0, fma(slope(0, 1), r1, slope(0, 2) * r2));
      (w_last * gx).sum().store(out[Out::kGradient] + at);
      (R::by_node(&stencil.dw[1][0][particle], kTileSize) * across).sum().store(out[Out::kGradient + 1] + at);
    }
  }
}

template <class Real, int D, bool moments, bool gradient>
HWY_INLINE void scatter_rows(const TileStencil<Real, D, gradient>& stencil, const Quads<Real>* in,
                             int particle, Real* nodes) {
  using R = Row<Real>;
  using In = Records<D, moments, gradient>;
  constexpr int kLine = kScratchEdge * kQuad;
  const int at = quad_place<Real>(particle) * kQuad;
  Real* first = nodes + stencil.first[particle];
  const auto weight = [&](int d, int n) HWY_ATTR { return R::all(stencil.w[d][n][particle]); };
  const auto slope = [&](int d, int n) HWY_ATTR { return R::all(stencil.dw[d][n][particle]); };
  const auto record = [&](int k) HWY_ATTR { return R::repeated(in[k] + at); };
  const R w_last = R::by_node(&stencil.w[D - 1][0][particle], kTileSize);

  R q = record(0);
  if constexpr (moments) q = fma(node_offsets<Real>(), record(In::kMoment + D - 1), q);
  q = w_last * q;
  if constexpr (gradient)
    q = fma(R::by_node(&stencil.dw[D - 1][0][particle], kTileSize), record(In::kGradient + D - 1), q);

  // The first axis: line i is w_i (q + (i - 1) A_x) + dw_i T_x, all already weighted along the last axis.
  R x, tx;
  if constexpr (moments) x = w_last * record(In::kMoment);
  if constexpr (gradient) tx = w_last * record(In::kGradient);
  const auto line_value = [&](int i) HWY_ATTR {
    R value = q;
    if constexpr (moments) value = i == 0 ? q - x : i == 2 ? q + x : q;
    value = weight(0, i) * value;
    if constexpr (gradient) value = fma(slope(0, i), tx, value);
    return value;
  };
  if constexpr (D == 2) {
    for (int i = 0; i < 3; ++i) {
      Real* line = first + i * kLine;
      (R::load(line) + line_value(i)).store(line);
    }
  } else {
    R y, ty;
    if constexpr (moments) y = w_last * record(In::kMoment + 1);
    if constexpr (gradient) ty = w_last * record(In::kGradient + 1);
    for (int i = 0; i < 3; ++i) {
      const R value = line_value(i);
      R yi, ti;
      if constexpr (moments) yi = weight(0, i) * y;
      if constexpr (gradient) ti = weight(0, i) * ty;
      for (int j = 0; j < 3; ++j) {
        Real* line = first + (i * kScratchEdge + j) * kLine;
        R row = value;
        if constexpr (moments) row = j == 0 ? value - yi : j == 2 ? value + yi : value;
        R sum = fma(weight(1, j), row, R::load(line));
        if constexpr (gradient) sum = fma(slope(1, j), ti, sum);
        sum.store(line);
      }
    }
  }
}

}  // namespace firn::FIRN_ISA
