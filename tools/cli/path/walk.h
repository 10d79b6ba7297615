// Leads a specimen along a path.
#pragma once

#include <functional>

#include "tools/cli/path/description.h"
#include "tools/cli/path/specimen.h"

namespace firn {

struct PathPlace {
  std::int64_t step = 0;
  double time = 0;  // s
  std::size_t leg = 0;
};

using PathRow = std::function<void(const PathPlace&, const SpecimenState&)>;

/// Calls `row` at rest and after every step. Throws Error{numerics} where a stress that is to be kept cannot
/// be, within 1e-8 of the P-wave modulus, or where `until_stress` is not reached.
void walk(const PathDescription& path, const Specimen& specimen, const PathRow& row);

}  // namespace firn
