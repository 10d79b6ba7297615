// The runs that a study asks for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/scene/plan.h"
#include "tools/cli/study/description.h"

namespace firn {

struct StudyRun {
  std::vector<std::string> overrides;  // KEY=VALUE, all that apply to the scene
  int threads = 1, repeats = 1;
  /// By name: those that every study shows, and the axes of its sweeps.
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  std::string refused;    // why the scene may not have these settings; empty: it may
  double projected = 0;   // s, of one repeat
  std::uint64_t key = 0;  // of all that its results depend on but the program and the truth
};

/// The same runs in two sweeps count once. Throws Error{input} when no run can have one of the values, or
/// when the scene has no step.
std::vector<StudyRun> list_study_runs(const StudyDescription& study);

/// One for each cell size of the truth, coarse first. Throws Error{input}.
std::vector<StudyRun> list_reference_runs(const StudyDescription& study, const FinestRuns& truth);

/// The names of all axes, in the order of the text.
std::vector<std::string> axis_names(const StudyDescription& study);

/// The scene with the run's overrides. Throws Error{input}.
Plan plan_run(const StudyDescription& study, const StudyRun& run);

/// What stands after `firn run SCENE` to have this run.
std::string arguments_text(const StudyRun& run);

/// Nodes that a particle's kernel reaches.
double nodes_per_particle(const Plan& plan);

}  // namespace firn
