// firn info: what a frame, or the folder of a run, holds.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace firn {

struct InfoOptions {
  std::filesystem::path path;  // a frame or a folder
  bool json = false;
  std::vector<std::string> csv;  // attributes; of a frame only
};

/// Returns the exit code. Throws Error{ExitCode::input} for a path that is neither, or an attribute that is
/// not there.
int run_info(const InfoOptions& options, std::ostream& out);

/// The folder's part of it.
int run_folder_info(const std::filesystem::path& folder, bool json, std::ostream& out);

}  // namespace firn
