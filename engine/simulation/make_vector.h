// The vectorised path of one dimension and precision: one translation unit each, as for the plain one.
#pragma once

#include "engine/simulation/simulation.h"
#include "engine/vector/isa.h"

namespace firn {

template <class Real, int D>
std::unique_ptr<Simulation> make_vector(const Plan& plan, std::span<const Seeds> seeds, Isa isa);

}  // namespace firn
