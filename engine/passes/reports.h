// What a pass over particles saw. Every part joins in the same order, whatever the threads do: the largest of
// anything does not depend on it, sums are added block by block.
#pragma once

#include <algorithm>
#include <cstdint>

namespace firn {

struct Motion {
  double max_speed = 0;         // m/s, of particles
  double max_displacement = 0;  // m, along one axis in this step
  std::int64_t invalid = 0;     // particles whose state is not finite or beyond the grid's reach

  void join(const Motion& other) {
    max_speed = std::max(max_speed, other.max_speed);
    max_displacement = std::max(max_displacement, other.max_displacement);
    invalid += other.invalid;
  }
};

struct MaterialReport {
  double max_wave_modulus = 0;  // Pa
  double dissipated = 0;        // J
  std::int64_t capped = 0;      // particles on which a cap of the model acted
  std::int64_t invalid = 0;     // particles whose answer is not finite

  void join(const MaterialReport& other) {
    max_wave_modulus = std::max(max_wave_modulus, other.max_wave_modulus);
    dissipated += other.dissipated;
    capped += other.capped;
    invalid += other.invalid;
  }
};

}  // namespace firn
