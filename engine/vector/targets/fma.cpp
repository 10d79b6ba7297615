#include "engine/vector/targets/fma.h"

#include "engine/vector/wide.h"

namespace firn::FIRN_ISA {
namespace {

// Chains that do not wait for each other: two units of four cycles latency need eight, and with the two
// factors these fit into the sixteen registers of AVX2.
constexpr int kChains = 12;
constexpr int kLength = 20000;

template <class Real>
FmaBurst burst() {
  using L = Wide<Real, 1>;
  // Each chain tends to 1: no denormal numbers. That it is the factor that changes keeps a set without
  // fused multiply-adds from hoisting the product out of the loop.
  const L factor(0.5), summand(0.5);
  Wide<Real, kChains> chains(0);
  for (int n = 0; n < kLength; ++n) {
#pragma GCC unroll 12
    for (int k = 0; k < kChains; ++k) chains.v[k] = hn::MulAdd(chains.v[k], factor.v[0], summand.v[0]);
  }
  return {std::int64_t{2} * kLength * chains.kLanes, static_cast<double>(largest(chains))};
}

}  // namespace

template <>
FmaBurst fma_burst<float>() {
  return burst<float>();
}
template <>
FmaBurst fma_burst<double>() {
  return burst<double>();
}

}  // namespace firn::FIRN_ISA
