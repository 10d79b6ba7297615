// The instruction sets the vectorised path is built for, and which of them this processor has.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "engine/passes/sort_kernels.h"
#include "engine/vector/fma.h"
#include "engine/vector/kernel_tables.h"

namespace firn {

enum class Isa { sse4, avx2, avx512 };
inline constexpr std::array kIsas{Isa::avx512, Isa::avx2, Isa::sse4};  // the widest first

std::string_view name(Isa isa);

/// Whether this processor has it.
bool available(Isa isa);

/// The widest one that this processor has, or the one that the environment variable FIRN_ISA names: a cache
/// has the same bits on every machine that computes with the same set. Empty when the processor has none
/// of them, or FIRN_ISA is "none". Throws Error{environment} for a name it does not know or a set the
/// processor lacks.
std::optional<Isa> best_isa();

template <class Real, int D>
KernelTable<Real, D> kernel_table(Isa isa);

template <class Real, int D>
SortKernels<Real> sort_kernels(Isa isa);

/// Some hundredths of a millisecond of multiply-adds.
template <class Real>
FmaBurst fma_burst(Isa isa);

}  // namespace firn
