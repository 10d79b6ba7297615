// firn bench --vs: this build and another one, measured in turns.
#pragma once

#include <ostream>

#include "tools/cli/bench_list.h"

namespace firn {

/// Measures each run with both programs as child processes, round after round, and prints what both took.
/// Returns the exit code; throws Error.
int compare_builds(const BenchOptions& options, const std::vector<BenchRun>& runs, std::ostream& out);

}  // namespace firn
