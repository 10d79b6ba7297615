// The transfer schemes of one dimension and precision: one translation unit each, so that they build in
// parallel.
#pragma once

#include "engine/simulation/simulation.h"

namespace firn {

template <class Real, int D>
std::unique_ptr<Simulation> make_plain(const Plan& plan, std::span<const Seeds> seeds);

}  // namespace firn
