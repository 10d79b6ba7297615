// What the machine can do at most, measured in the same minutes as what is compared with it: multiply-adds on
// registers, and reading from memory.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "tools/cli/bench_list.h"
#include "tools/cli/bench_table.h"

namespace firn {

class Ceilings {
 public:
  /// Measures once more what `run` is to be compared with; the best of all times counts. A run of the plain
  /// path is compared with nothing.
  void measure(const BenchRun& run);

  /// Of what was measured before.
  double gflops(const BenchRun& run) const { return fma_.at(key(run)); }
  double gb_per_s(const BenchRun& run) const { return read_.at(run.threads); }

  /// A line each, in an order of their own.
  BenchRows rows() const;

 private:
  using FmaKey = std::tuple<Isa, Precision, int>;
  static FmaKey key(const BenchRun& run) { return {run.isa.value(), run.precision(), run.threads}; }

  std::vector<std::uint64_t> array_;  // what is read
  std::map<FmaKey, double> fma_;      // GFLOP/s
  std::map<int, double> read_;        // GB/s by threads
};

}  // namespace firn
