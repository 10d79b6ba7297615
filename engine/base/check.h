// Invariants right of the Plan: what a user's mistake cannot break. A failed check is a bug in Firn.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace firn {

[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "firn: internal error: %s does not hold (%s:%d)\n", condition, file, line);
  std::abort();
}

}  // namespace firn

#define FIRN_CHECK(condition) \
  static_cast<bool>(condition) ? static_cast<void>(0) : ::firn::check_failed(#condition, __FILE__, __LINE__)
