// A leg as the steps it is made of: strains that are driven, and faces whose stress is.
#pragma once

#include <optional>
#include <vector>

#include "tools/cli/path/description.h"
#include "tools/cli/path/specimen.h"

namespace firn {

/// Axes that strain alike, so that each carries this stress.
struct DrivenStress {
  std::vector<int> axes;
  double from, to;  // Pa, positive in tension; even in between
};

/// One way of a leg; a cycle is three of them.
struct Way {
  Strains strains;  // added over it
  std::vector<DrivenStress> stresses;
  double time;  // s
  int steps;
};

/// The ways of a leg that begins in `state`. `accuracy`: stresses that differ by less are the same (Pa).
std::vector<Way> ways(const LegDescription& leg, const SpecimenState& state, double accuracy);

/// The stress that `until_stress` is about.
double driven_stress(const LegDescription& leg, const SpecimenState& state);

}  // namespace firn
