#include "engine/vector/isa.h"

#include <cstdlib>

#include <fmt/format.h>
#include <hwy/targets.h>

#include "engine/base/error.h"
#include "engine/vector/targets/fma.h"
#include "engine/vector/targets/sorts.h"
#include "engine/vector/targets/tables.h"

namespace firn {

bool available(Isa isa) {
  const auto targets = static_cast<std::uint64_t>(hwy::SupportedTargets());
  switch (isa) {
    case Isa::avx512:
      return (targets & HWY_AVX3) != 0;
    case Isa::avx2:
      return (targets & HWY_AVX2) != 0;
    case Isa::sse4:
      return (targets & HWY_SSE4) != 0;
  }
  return false;
}

std::string_view name(Isa isa) {
  return isa == Isa::avx512 ? "avx512" : isa == Isa::avx2 ? "avx2" : "sse4";
}

std::optional<Isa> best_isa() {
  const char* wanted = std::getenv("FIRN_ISA");
  if (wanted == nullptr || *wanted == '\0') {
    for (const Isa isa : kIsas)
      if (available(isa)) return isa;
    return std::nullopt;
  }
  if (std::string_view(wanted) == "none") return std::nullopt;
  for (const Isa isa : kIsas) {
    if (name(isa) != wanted) continue;
    if (available(isa)) return isa;
    throw Error(ExitCode::environment, fmt::format("FIRN_ISA={}: this processor does not have it", wanted));
  }
  throw Error(
      ExitCode::environment,
      fmt::format("FIRN_ISA={}: unknown; allowed: avx512, avx2, sse4, none (the plain path)", wanted));
}

template <class Real, int D>
KernelTable<Real, D> kernel_table(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return avx512::kernel_table<Real, D>();
    case Isa::avx2:
      return avx2::kernel_table<Real, D>();
    case Isa::sse4:
      break;
  }
  return sse4::kernel_table<Real, D>();
}
template KernelTable<float, 2> kernel_table(Isa);
template KernelTable<float, 3> kernel_table(Isa);
template KernelTable<double, 2> kernel_table(Isa);
template KernelTable<double, 3> kernel_table(Isa);

template <class Real, int D>
SortKernels<Real> sort_kernels(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return avx512::sort_kernels<Real, D>();
    case Isa::avx2:
      return avx2::sort_kernels<Real, D>();
    case Isa::sse4:
      break;
  }
  return sse4::sort_kernels<Real, D>();
}
template SortKernels<float> sort_kernels<float, 2>(Isa);
template SortKernels<float> sort_kernels<float, 3>(Isa);
template SortKernels<double> sort_kernels<double, 2>(Isa);
template SortKernels<double> sort_kernels<double, 3>(Isa);

template <class Real>
FmaBurst fma_burst(Isa isa) {
  switch (isa) {
    case Isa::avx512:
      return avx512::fma_burst<Real>();
    case Isa::avx2:
      return avx2::fma_burst<Real>();
    case Isa::sse4:
      break;
  }
  return sse4::fma_burst<Real>();
}
template FmaBurst fma_burst<float>(Isa);
template FmaBurst fma_burst<double>(Isa);

}  // namespace firn
