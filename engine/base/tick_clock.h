// Counts the processor's ticks by part, for shares of a time that is measured otherwise; with null it does
// nothing.
#pragma once

#include <cstddef>
#include <cstdint>

#include <x86intrin.h>

namespace firn {

class TickClock {
 public:
  /// `ticks`: a counter for each part, or null.
  explicit TickClock(std::uint64_t* ticks) : ticks_(ticks), last_(ticks == nullptr ? 0 : __rdtsc()) {}
  /// Adds what has passed since the last call to `part`.
  void lap(std::size_t part) {
    if (ticks_ == nullptr) return;
    const std::uint64_t now = __rdtsc();
    ticks_[part] += now - last_;
    last_ = now;
  }

 private:
  std::uint64_t* ticks_;
  std::uint64_t last_;
};

}  // namespace firn
