// Work that may abort, crash, hang or eat all memory, done in a child process so that only the child is lost.
// For third-party readers of files that a user did not write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace firn {

struct ChildLimits {
  std::uint64_t memory;      // bytes beyond what this process has mapped; not enforced under AddressSanitizer
  unsigned cpu_seconds;      // processor time
  std::uint64_t answer;      // bytes the child may send back
  bool opens_files = false;  // whether the work itself opens files; otherwise the kernel refuses every open
};

/// What `work` returns, computed in a child. `work` may throw: an Error's or std::exception's message comes
/// back in an Error{input} "<subject>: <message>". A crash, too much time or memory becomes such an Error as
/// well. `work` must not rely on other threads.
std::vector<std::uint8_t> run_in_child(const std::string& subject, const ChildLimits& limits,
                                       const std::function<std::vector<std::uint8_t>()>& work);

}  // namespace firn
