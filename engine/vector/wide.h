// A lane of several vector registers: how materials, written once for a number (engine/math/lane.h), run on
// many particles at a time. Compiled once per instruction set, in a namespace of its own (FIRN_ISA), so that
// no code of one set is ever linked into another; included by engine/vector/targets only.
#pragma once

#include <hwy/highway.h>
//
#include <hwy/contrib/math/math-inl.h>

#include "engine/math/lane.h"

#ifndef FIRN_ISA
#error "FIRN_ISA must name the instruction set this file is compiled for"
#endif

namespace firn::FIRN_ISA {

namespace hn = hwy::HWY_NAMESPACE;

/// `N` registers of `R`, computed side by side: independent work hides the latency of each.
template <class R, int N>
struct Wide {
  using Tag = hn::ScalableTag<R>;
  static constexpr int kLanes = N * static_cast<int>(hn::MaxLanes(Tag()));

  hn::Vec<Tag> v[N];

  Wide() = default;
  HWY_INLINE explicit Wide(double x) {
    for (int i = 0; i < N; ++i) v[i] = hn::Set(Tag(), static_cast<R>(x));
  }

  static HWY_INLINE Wide load(const R* p) {
    Wide out;
    for (int i = 0; i < N; ++i) out.v[i] = hn::Load(Tag(), p + i * (kLanes / N));
    return out;
  }
  HWY_INLINE void store(R* p) const {
    for (int i = 0; i < N; ++i) hn::Store(v[i], Tag(), p + i * (kLanes / N));
  }
};

template <class R, int N>
struct WideMask {
  hn::Mask<hn::ScalableTag<R>> m[N];
};

/// Applies f(register...) to each register of the arguments.
template <class R, int N, class F, class... A>
HWY_INLINE Wide<R, N> each(F f, const Wide<R, N>& a, const A&... rest) {
  Wide<R, N> out;
  for (int i = 0; i < N; ++i) out.v[i] = f(a.v[i], rest.v[i]...);
  return out;
}
template <class R, int N, class F>
HWY_INLINE WideMask<R, N> compare(F f, const Wide<R, N>& a, const Wide<R, N>& b) {
  WideMask<R, N> out;
  for (int i = 0; i < N; ++i) out.m[i] = f(a.v[i], b.v[i]);
  return out;
}

#define FIRN_WIDE_BINARY(op, function)                                         \
  template <class R, int N>                                                    \
  HWY_INLINE Wide<R, N> op(const Wide<R, N>& a, const Wide<R, N>& b) {         \
    return each([](auto x, auto y) HWY_ATTR { return function(x, y); }, a, b); \
  }
FIRN_WIDE_BINARY(operator+, hn::Add)
FIRN_WIDE_BINARY(operator-, hn::Sub)
FIRN_WIDE_BINARY(operator*, hn::Mul)
FIRN_WIDE_BINARY(operator/, hn::Div)
FIRN_WIDE_BINARY(min, hn::Min)
FIRN_WIDE_BINARY(max, hn::Max)
FIRN_WIDE_BINARY(copysign, hn::CopySign)
#undef FIRN_WIDE_BINARY

#define FIRN_WIDE_UNARY(op, expression)                         \
  template <class R, int N>                                     \
  HWY_INLINE Wide<R, N> op(const Wide<R, N>& a) {               \
    return each([](auto x) HWY_ATTR { return expression; }, a); \
  }
FIRN_WIDE_UNARY(operator-, hn::Neg(x))
FIRN_WIDE_UNARY(sqrt, hn::Sqrt(x))
FIRN_WIDE_UNARY(abs, hn::Abs(x))
FIRN_WIDE_UNARY(floor, hn::Floor(x))
FIRN_WIDE_UNARY(exp, hn::Exp(hn::ScalableTag<R>(), x))
FIRN_WIDE_UNARY(log, hn::Log(hn::ScalableTag<R>(), x))
FIRN_WIDE_UNARY(sin, hn::Sin(hn::ScalableTag<R>(), x))
#undef FIRN_WIDE_UNARY

#define FIRN_WIDE_COMPARE(op, function)                                           \
  template <class R, int N>                                                       \
  HWY_INLINE WideMask<R, N> op(const Wide<R, N>& a, const Wide<R, N>& b) {        \
    return compare([](auto x, auto y) HWY_ATTR { return function(x, y); }, a, b); \
  }
FIRN_WIDE_COMPARE(operator==, hn::Eq)
FIRN_WIDE_COMPARE(operator<, hn::Lt)
FIRN_WIDE_COMPARE(operator<=, hn::Le)
FIRN_WIDE_COMPARE(operator>, hn::Gt)
FIRN_WIDE_COMPARE(operator>=, hn::Ge)
#undef FIRN_WIDE_COMPARE

template <class R, int N>
HWY_INLINE WideMask<R, N> operator&(const WideMask<R, N>& a, const WideMask<R, N>& b) {
  WideMask<R, N> out;
  for (int i = 0; i < N; ++i) out.m[i] = hn::And(a.m[i], b.m[i]);
  return out;
}
template <class R, int N>
HWY_INLINE WideMask<R, N> operator|(const WideMask<R, N>& a, const WideMask<R, N>& b) {
  WideMask<R, N> out;
  for (int i = 0; i < N; ++i) out.m[i] = hn::Or(a.m[i], b.m[i]);
  return out;
}
template <class R, int N>
HWY_INLINE WideMask<R, N> operator!(const WideMask<R, N>& a) {
  WideMask<R, N> out;
  for (int i = 0; i < N; ++i) out.m[i] = hn::Not(a.m[i]);
  return out;
}
template <class R, int N>
HWY_INLINE Wide<R, N> select(const WideMask<R, N>& m, const Wide<R, N>& a, const Wide<R, N>& b) {
  Wide<R, N> out;
  for (int i = 0; i < N; ++i) out.v[i] = hn::IfThenElse(m.m[i], a.v[i], b.v[i]);
  return out;
}
template <class R, int N>
HWY_INLINE bool any(const WideMask<R, N>& m) {
  bool out = false;
  for (int i = 0; i < N; ++i) out = out || !hn::AllFalse(hn::ScalableTag<R>(), m.m[i]);
  return out;
}
template <class R, int N>
HWY_INLINE int count(const WideMask<R, N>& m) {
  std::size_t out = 0;
  for (int i = 0; i < N; ++i) out += hn::CountTrue(hn::ScalableTag<R>(), m.m[i]);
  return static_cast<int>(out);
}

template <class R, int N>
HWY_INLINE Wide<R, N> flip_sign(const Wide<R, N>& x, const Wide<R, N>& sign) {
  return each([](auto a, auto s)
                  HWY_ATTR { return hn::Xor(a, hn::And(s, hn::SignBit(hn::ScalableTag<R>()))); },
              x, sign);
}

// 1/sqrt(x) to 11 bits or better.
template <class V>
HWY_INLINE V rough_inverse_root(V x) {
  using R = hn::TFromV<V>;
  if constexpr (sizeof(R) == 4) {
    return hn::ApproximateReciprocalSqrt(x);
  } else {
#if HWY_TARGET <= HWY_AVX3
    return V{_mm512_rsqrt14_pd(x.raw)};
#else
    return hn::Div(hn::Set(hn::DFromV<V>(), R(1)), hn::Sqrt(x));
#endif
  }
}
template <class R, int N>
HWY_INLINE Wide<R, N> rough_inverse_sqrt(const Wide<R, N>& a) {
  return each([](auto x) HWY_ATTR { return rough_inverse_root(x); }, a);
}

// y <- y (3/2 - x y^2 / 2) doubles the digits.
template <class R, int N>
HWY_INLINE Wide<R, N> refined_inverse_sqrt(const Wide<R, N>& x, const Wide<R, N>& y) {
  return y * (Wide<R, N>(1.5) - (x * y) * (y * Wide<R, N>(0.5)));
}
template <class R, int N>
HWY_INLINE Wide<R, N> inverse_sqrt(const Wide<R, N>& x) {
  Wide<R, N> y = refined_inverse_sqrt(x, rough_inverse_sqrt(x));
#if HWY_TARGET <= HWY_AVX3
  if constexpr (sizeof(R) == 8) y = refined_inverse_sqrt(x, y);
#endif
  return y;
}

/// The first `n` numbers of `from` to `to`; of the registers' width, what lies beyond is neither read nor
/// written.
template <class R>
HWY_INLINE void copy_first(const R* from, R* to, int n) {
#if HWY_TARGET <= HWY_AVX3
  const hn::ScalableTag<R> tag;
  for (const int width = static_cast<int>(hn::MaxLanes(tag)); n > 0; n -= width, from += width, to += width) {
    const auto mask = hn::FirstN(tag, static_cast<std::size_t>(n));
    hn::BlendedStore(hn::MaskedLoad(mask, tag, from), mask, tag, to);
  }
#else
  for (int i = 0; i < n; ++i) to[i] = from[i];
#endif
}

// Aligned, and a multiple of a register; the compiler would call memcpy and memset for as much or use string
// instructions, which take their time to start.
template <int n, class R>
HWY_INLINE void copy_numbers(const R* from, R* to) {
  const hn::ScalableTag<R> tag;
  for (int i = 0; i < n; i += static_cast<int>(hn::MaxLanes(tag))) {
    auto v = hn::Load(tag, from + i);
    asm("" : "+v"(v.raw));
    hn::Store(v, tag, to + i);
  }
}
template <int n, class R>
HWY_INLINE void fill_zero(R* to) {
  const hn::ScalableTag<R> tag;
  auto zero = hn::Zero(tag);
  for (int i = 0; i < n; i += static_cast<int>(hn::MaxLanes(tag))) {
    asm("" : "+v"(zero.raw));
    hn::Store(zero, tag, to + i);
  }
}

/// Asks for the `bytes` from `p` on, before they are needed.
template <int locality>
HWY_INLINE void prefetch(const void* p, std::size_t bytes) {
  for (std::size_t line = 0; line < bytes; line += 64)
    __builtin_prefetch(static_cast<const char*>(p) + line, 0, locality);
}

template <class R, int N>
HWY_INLINE R largest(const Wide<R, N>& a) {
  auto m = a.v[0];
  for (int i = 1; i < N; ++i) m = hn::Max(m, a.v[i]);
  return hn::GetLane(hn::MaxOfLanes(hn::ScalableTag<R>(), m));
}

}  // namespace firn::FIRN_ISA

namespace firn {

template <class R, int N>
struct LaneTraits<FIRN_ISA::Wide<R, N>> {
  using Real = R;
  using Mask = FIRN_ISA::WideMask<R, N>;
};

}  // namespace firn
