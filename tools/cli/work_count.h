// How much the vectorised step has to compute and to move for a particle: what its time is compared with.
//
// Useful work only. Computed: the transfers' arithmetic on the nodes that a particle touches (not on what
// pads a register), and the material's. Not the indices, the checks, the sort, or what is per node. Moved:
// what one fused pass reads and writes of a particle, and the outboxes, written by one pass and read by the
// next.
#pragma once

#include <cstdint>
#include <span>

#include "engine/scene/plan.h"

namespace firn {

/// For one particle and step.
struct Work {
  double flops = 0, bytes = 0;
};

/// Gather and scatter of the row kernels (engine/vector/row_kernels.h, transfer_kernels.h), 2D or 3D.
int transfer_flops(int dimension, Transfer transfer);

/// One update of a material, counted on a point near rest.
std::int64_t update_flops(const Material& material, int dimension, Precision precision);

/// The mean over all particles. `particles`: of each batch.
Work count_work(const Plan& plan, std::span<const std::size_t> particles, std::size_t occupied_blocks);

}  // namespace firn
