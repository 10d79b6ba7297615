// The instruction sets the vectorised path is built for, and which of them this processor has.
#pragma once

#include <optional>
#include <string_view>

#include "engine/vector/kernel_tables.h"

namespace firn {

enum class Isa { sse4, avx2, avx512 };

std::string_view name(Isa isa);

/// The widest one that this processor has, or the one that the environment variable FIRN_ISA names: a cache
/// has the same bits on every machine that computes with the same set. Empty when the processor has none
/// of them, or FIRN_ISA is "none". Throws Error{environment} for a name it does not know or a set the
/// processor lacks.
std::optional<Isa> best_isa();

template <class Real, int D>
KernelTable<Real, D> kernel_table(Isa isa);

}  // namespace firn
