// firn plan: what a scene would cost, without running it.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "engine/scene/estimate.h"

namespace firn {

/// Effects found and absent, columns, counts, memory, disk and time.
nlohmann::json plan_json(const Plan& plan, const Estimate& estimate);
void print_plan(const Plan& plan, const Estimate& estimate, std::ostream& out);

int run_plan(const std::filesystem::path& scene, const std::vector<std::string>& overrides, bool json,
             std::ostream& out);

}  // namespace firn
