// firn bench weights: what weights cost that are computed where they are used, beside stored ones.
#pragma once

#include <ostream>

namespace firn {

struct BenchWeightsOptions {
  int particles = 1000000;  // about so many: a cube of whole cells, eight in each
  int rounds = 5;
  bool json = false;
};

/// Returns the exit code.
int run_bench_weights(const BenchWeightsOptions& options, std::ostream& out);

}  // namespace firn
