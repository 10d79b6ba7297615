#include "engine/simulation/simulation.h"

#include "engine/base/check.h"
#include "engine/simulation/make_plain.h"
#include "engine/simulation/make_vector.h"

namespace firn {

std::unique_ptr<Simulation> make_simulation(const Plan& plan, std::span<const Seeds> seeds) {
  const bool wide = plan.scene.simulation.precision == Precision::double_;
  if (const auto isa = plan.path.isa) {
    if (plan.dimension() == 2)
      return wide ? make_vector<double, 2>(plan, seeds, *isa) : make_vector<float, 2>(plan, seeds, *isa);
    return wide ? make_vector<double, 3>(plan, seeds, *isa) : make_vector<float, 3>(plan, seeds, *isa);
  }
  switch (plan.dimension()) {
    case 1:
      return wide ? make_plain<double, 1>(plan, seeds) : make_plain<float, 1>(plan, seeds);
    case 2:
      return wide ? make_plain<double, 2>(plan, seeds) : make_plain<float, 2>(plan, seeds);
    default:
      return wide ? make_plain<double, 3>(plan, seeds) : make_plain<float, 3>(plan, seeds);
  }
}

}  // namespace firn
