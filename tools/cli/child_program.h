// Another program, run to its end.
#pragma once

#include <string>
#include <vector>

namespace firn {

struct ProgramAnswer {
  int status = 0;  // exit code, or 128 + the signal that ended it
  std::string out, error;
};

/// Runs the file `program` with nothing to read and collects what it prints; arguments without its own name.
/// Throws Error{input} "<program>: why" when it cannot be started, or prints more than a megabyte.
ProgramAnswer run_program(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace firn
