// Where the time and the memory of a run went: each effect of the scene with its price.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "engine/output/frame_writer.h"
#include "engine/simulation/simulation.h"

namespace firn {

/// One object a part, the dearest first; shares are of the time all of them took together. `writing`: after
/// the last frame.
nlohmann::json costs_json(const Plan& plan, const Simulation& simulation, std::int64_t steps,
                          const FrameWriter::Times& writing);

/// The same in a line: "transfer 48 %, snow 31 % (elasticity, plasticity), ..., caches hidden".
std::string costs_line(const nlohmann::json& costs);

}  // namespace firn
