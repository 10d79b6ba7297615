// What a plan will cost, known before anything is seeded.
#pragma once

#include <vector>

#include "engine/scene/plan.h"

namespace firn {

struct Estimate {
  std::vector<double> particles;  // of each body
  double total_particles = 0;
  double blocks = 0;  // of the grid, at the start
  double particle_bytes = 0, grid_bytes = 0;
  /// What the run holds at most: particles, grid, sorting, and the frames on their way to disk.
  double peak_bytes = 0;
  double disk_bytes = 0;    // all frames
  double wave_speed = 0;    // m/s, fastest P-wave at rest
  double speed = 0;         // m/s, fastest body or collider at the start
  double dt = 0;            // s, at the start
  double steps = 0;         // at that dt
  double core_seconds = 0;  // of all steps on one core, from the costs below
};

/// Core nanoseconds per particle and step, by what the material has to compute: the passes' seconds in
/// run.json times the cores. Measured on an AMD EPYC (Zen 4), the plain path with scenes/snowball.toml,
/// scenes/elastic_cubes.toml and disks of the same materials, the vectorised one by `firn bench`; other
/// machines differ.
struct StepCost {
  double transfers = 0, plain_energy = 0, decomposition = 0;
};
/// With the quadratic kernel and USL.
StepCost step_cost(const PathPlan& path, int dimension, Precision precision);

Estimate estimate(const Plan& plan);

}  // namespace firn
