// `firn element`: a material point driven from outside, one JSON line in, one out, in double precision.
#pragma once

#include <istream>
#include <ostream>

namespace firn {

/// Returns the exit code: 2 when a line was bad (its answer is {"id":..,"error":".."}), else 0.
int run_element(std::istream& in, std::ostream& out);

}  // namespace firn
