// firn bench: particle updates per second, pass by pass, beside what the machine could do.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace firn {

struct BenchOptions {
  std::vector<std::string> scenes;     // files or built-in cases; empty: kBenchDefaults (bench_cases.h)
  std::vector<std::string> overrides;  // a.b=v
  std::vector<int> threads;            // empty: 1 and all cores
  std::vector<std::string> isas;       // empty: the widest, or what kBenchDefaults says
  int rounds = 5;
  int steps = 0;                  // of a round; 0: the whole scene, or what the built-in case says
  std::optional<std::string> vs;  // another build of this program to compare with
  bool json = false;
};

/// Returns the exit code; throws Error.
int run_bench(const BenchOptions& options, std::ostream& out);

}  // namespace firn
