// firn schema: the scene format, for programs and, with --example, for people.
#pragma once

#include <ostream>

namespace firn {

/// Writes the JSON Schema, or the commented example scene; returns the exit code.
int run_schema(bool example, std::ostream& out);

}  // namespace firn
