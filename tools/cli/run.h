// firn run: simulate a scene and write its caches.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace firn {

struct RunOptions {
  std::filesystem::path scene;
  std::filesystem::path out;           // empty: out/<scene's name>
  std::vector<std::string> overrides;  // a.b=v
  std::string frames;                  // A:B, :B or A:; empty: all
  int threads = 0;                     // 0: all cores
  std::uint64_t max_memory = 0;        // bytes; 0: what the machine has
  bool overwrite = false;
};

/// Returns the exit code; throws Error.
int run_scene(const RunOptions& options);

}  // namespace firn
