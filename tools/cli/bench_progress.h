// What `firn bench` is measuring now: a line that redraws itself on a terminal, and nothing anywhere else.
#pragma once

#include <iostream>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/nearest_name.h"

namespace firn {

class BenchProgress {
 public:
  explicit BenchProgress(int rounds) : rounds_(rounds), on_(isatty(STDERR_FILENO) != 0) {}
  ~BenchProgress() { finish(); }
  BenchProgress(const BenchProgress&) = delete;
  BenchProgress& operator=(const BenchProgress&) = delete;

  void show(std::string_view what) {
    // Shorter than a terminal is wide: a line that wraps cannot be redrawn.
    if (on_) std::cerr << "\r\x1b[K" << printable(what, 70) << std::flush;
    line_open_ = on_;
  }
  void show(int round, std::string_view what) { show(fmt::format("round {}/{}: {}", round, rounds_, what)); }
  /// Removes the line, if there is one.
  void finish() {
    if (line_open_) std::cerr << "\r\x1b[K" << std::flush;
    line_open_ = false;
  }

 private:
  int rounds_;
  bool on_, line_open_ = false;
};

}  // namespace firn
