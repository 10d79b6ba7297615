// `firn element PATH`: leads a material along a strain path and writes what it answers as CSV.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace firn {

struct PathOptions {
  std::filesystem::path path;
  std::filesystem::path out;  // empty: to the stream
  std::vector<std::string> overrides;
};

/// Returns the exit code. What was computed before a failure is written as well.
int run_element_path(const PathOptions& options, std::ostream& out);

}  // namespace firn
