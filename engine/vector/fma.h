// The most an instruction set can compute: multiply-adds on registers and nothing else. `firn bench` measures
// it to say how far from it the simulation is.
#pragma once

#include <cstdint>

namespace firn {

/// What one burst of multiply-adds did.
struct FmaBurst {
  std::int64_t flops;  // floating-point operations, two for a multiply-add
  double result;       // means nothing; that it is needed keeps the work from being optimised away
};

}  // namespace firn
