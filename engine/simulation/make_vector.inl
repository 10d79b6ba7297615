#pragma once

#include "engine/simulation/make_vector.h"
#include "engine/simulation/vector_simulation.h"

namespace firn {

template <class Real, int D>
std::unique_ptr<Simulation> make_vector(const Plan& plan, std::span<const Seeds> seeds, Isa isa) {
  return std::make_unique<VectorSimulation<Real, D>>(plan, seeds, kernel_table<Real, D>(isa),
                                                     sort_kernels<Real, D>(isa));
}

}  // namespace firn
