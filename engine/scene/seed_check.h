// What is doubtful about where particles start.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/scene/plan.h"
#include "engine/scene/seeding.h"

namespace firn {

/// A sentence for each body that starts partly inside a collider or outside the domain, with how much of it:
/// there its particles take on the wall's velocity at the first step, and what is squeezed may burst.
/// `seeds`: one per body.
std::vector<std::string> check_seeds(const Plan& plan, std::span<const Seeds> seeds);

/// The particles of all bodies, one entry per body; what is doubtful about them goes to `warnings`. Throws
/// Error{input} when a load acts on none of them.
std::vector<Seeds> seed_bodies(const Plan& plan, std::vector<std::string>& warnings);

}  // namespace firn
