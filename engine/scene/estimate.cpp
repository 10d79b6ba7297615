#include "engine/scene/estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/grid/block_layout.h"
#include "engine/scene/seeding.h"
#include "engine/scene/with_kernel.h"
#include "materials/model_info.h"

namespace firn {
namespace {

template <int D>
double wave_speed_at_rest(const Material& material, double density) {
  return std::visit(
      [&](const auto& model) {
        auto point = model.template at_rest<double, D>();
        return std::sqrt(model.update(point, 0.0).wave_modulus / density);
      },
      material);
}

double wave_speed_at_rest(const BatchPlan& batch, int dimension) {
  switch (dimension) {
    case 1:
      return wave_speed_at_rest<1>(batch.law, batch.density);
    case 2:
      return wave_speed_at_rest<2>(batch.law, batch.density);
    default:
      return wave_speed_at_rest<3>(batch.law, batch.density);
  }
}

// Blocks with a centre less than `reach` block edges outside the body, counted on a lattice that is coarsened
// for huge bodies.
double count_blocks(const Shape& shape, int dimension, double h, double reach) {
  const Bounds bounds = shape.bounds();
  if (bounds.empty()) return 0;
  double edge = kBlockEdge * h;
  const auto lattice_points = [&] {
    double n = 1;
    for (int d = 0; d < dimension; ++d) n *= std::ceil((bounds.max[d] - bounds.min[d]) / edge) + 3;
    return n;
  };
  while (lattice_points() > 1e6) edge *= 2;
  const double near = (reach - 0.5) * edge + 0.5 * kBlockEdge * h;
  std::vector<Vec3> centres;
  std::array<int, 3> n{1, 1, 1};
  for (int d = 0; d < dimension; ++d)
    n[static_cast<std::size_t>(d)] = static_cast<int>(std::ceil((bounds.max[d] - bounds.min[d]) / edge)) + 3;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k) {
        Vec3 c = Vec3::Zero();
        const std::array<int, 3> index{i, j, k};
        for (int d = 0; d < dimension; ++d)
          c[d] = bounds.min[d] + (index[static_cast<std::size_t>(d)] - 0.5) * edge;
        centres.push_back(c);
      }
  std::vector<double> phi(centres.size());
  shape.distance(centres, phi);
  const auto blocks = std::count_if(phi.begin(), phi.end(), [&](double x) { return x < near; });
  return static_cast<double>(blocks) * std::pow(edge / (kBlockEdge * h), dimension);
}

/// Of the body's blocks, those with particles, and those that their kernels reach besides.
struct BlockCounts {
  double occupied, all;
};
BlockCounts count_blocks(const Shape& shape, int dimension, double h) {
  const double half = 0.5 * std::sqrt(dimension);
  return {count_blocks(shape, dimension, h, 0.5 * half + 0.25), count_blocks(shape, dimension, h, half + 1)};
}

/// What `velocity` gives a body at most, m/s: of a formula the largest on a lattice of its bounds.
double fastest(const BodyDescription& body, const Shape* shape, int dimension) {
  const VectorFormula velocity(body.velocity, kPlaceNames);
  constexpr int kPoints = 9;
  const Bounds b =
      shape != nullptr ? along_axes(shape->bounds(), dimension) : Bounds{Vec3::Zero(), Vec3::Zero()};
  const int points = velocity.constant() ? 1 : static_cast<int>(power(kPoints, dimension));
  double speed = 0;
  for (int k = 0; k < points; ++k) {
    Vec3 x = Vec3::Zero();
    for (int d = 0, rest = k; d < dimension; ++d, rest /= kPoints)
      x[d] = b.min[d] + (b.max[d] - b.min[d]) * (rest % kPoints) / (kPoints - 1);
    const auto v = velocity({x.data(), 3});
    speed = std::max(speed, Vec3(v[0], v[1], v[2]).norm());
  }
  return speed;
}

// Bytes a point takes in a frame: float P and v, 64-bit id, compressed; others by their components.
constexpr double kPointBytes = 24;
constexpr double kAttributeComponentBytes = 3.6;

// What writing holds in memory for a particle, with `components` floats of requested attributes: P, v, pscale
// and id with them in two snapshots and in the grid being encoded; and beside the grid the order of its
// points and the column that is just copied into it, which are measured: 50 to 75 bytes.
constexpr double writing_bytes(double components) {
  constexpr double kAlways = 7 * sizeof(float) + sizeof(std::int64_t);
  return 3 * (kAlways + sizeof(float) * components) + 60;
}

double plain_grid_bytes(double blocks, const SimulationDescription& s, double real) {
  const double reals = s.dimension + 1 + (s.transfer == Transfer::flip ? s.dimension : 0);
  const int grids = s.stress_order == StressOrder::musl ? 2 : 1;
  return grids * blocks * power(kBlockEdge, s.dimension) * reals * real;
}

// Two grids, of which one is filled while the other is read, and an outbox for each block with particles.
double vector_grid_bytes(double blocks, double occupied, int dimension, double real) {
  return (2 * blocks * power(kBlockEdge, dimension) + occupied * power(2 * kBlockEdge, dimension)) *
         (kNodeReals * real);
}

/// How much more the transfers take than with the quadratic kernel and USL: by a particle's nodes, and by how
/// often the particles are passed over: twice, four times with USF, five and a half with MUSL, of whose
/// gathers each does a part.
double relative_transfers(const SimulationDescription& s) {
  const double nodes = with_kernel(s.kernel, [](auto kernel) { return kernel.nodes; });
  const double passes = s.stress_order == StressOrder::usl   ? 1
                        : s.stress_order == StressOrder::usf ? 2
                                                             : 2.75;
  return std::pow(nodes / QuadraticKernel::nodes, s.dimension) * passes;
}

/// ns a particle and step for formulas of forces, and a step of the plain path for starting its passes.
constexpr double kForcesNs = 150, kPlainStepNs = 5000;

}  // namespace

StepCost step_cost(const PathPlan& path, int dimension, Precision precision) {
  const bool wide = precision == Precision::double_;
  if (!path.isa) {
    const double slower = wide ? 1.1 : 1.0;
    switch (dimension) {
      case 1:
        return {12 * slower, 6 * slower, 17 * slower};
      case 2:
        return {95 * slower, 12 * slower, 122 * slower};
      default:
        return {480 * slower, 25 * slower, 455 * slower};
    }
  }
  // Registers of half the width take that much longer for the same lanes; the transfers' rows less so.
  const double narrow = *path.isa == Isa::avx512 ? 1 : *path.isa == Isa::avx2 ? 2 : 4;
  const double lanes = narrow * (wide ? 2 : 1), rows = std::sqrt(narrow) * (wide ? 1.5 : 1);
  if (dimension == 2) return {16 * rows, 1 * lanes, 5 * lanes};
  return {35 * rows, 2.5 * lanes, 22 * lanes};
}

Estimate estimate(const Plan& plan) {
  const SimulationDescription& s = plan.scene.simulation;
  Estimate e;
  StepCost cost = step_cost(plan.path, s.dimension, s.precision);
  cost.transfers *= relative_transfers(s);
  const double real = s.precision == Precision::double_ ? 8 : 4;
  double step_ns = plan.path.isa ? 0 : kPlainStepNs, widest = 0, occupied = 0;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b) {
    const BodyDescription& body = plan.scene.bodies[b];
    const BatchPlan& batch = plan.batches[plan.bodies[b].batch];
    const double n = estimate_count(body, plan.bodies[b].shape.get(), s.dimension, s.cell_size,
                                    plan.scene.file.parent_path());
    e.particles.push_back(n);
    e.total_particles += n;
    e.particle_bytes += n * (batch.columns.reals(s.dimension) * real + sizeof(std::uint32_t));
    widest = std::max(widest, n * s.dimension * s.dimension * real);
    const bool decomposes = find_model(batch.model)->decomposition != "none";
    if (plan.forces.any()) step_ns += n * kForcesNs;
    step_ns += n * (cost.transfers + (decomposes ? cost.decomposition : cost.plain_energy));
    if (plan.bodies[b].shape) {
      const BlockCounts blocks = count_blocks(*plan.bodies[b].shape, s.dimension, s.cell_size);
      e.blocks += blocks.all;
      occupied += blocks.occupied;
    }
    e.wave_speed = std::max(e.wave_speed, wave_speed_at_rest(batch, s.dimension));
    double speed = fastest(body, plan.bodies[b].shape.get(), s.dimension);
    if (plan.bodies[b].shape) {
      const Bounds bounds = along_axes(plan.bodies[b].shape->bounds(), s.dimension);
      speed += body.angular_velocity.norm() * std::numbers::pi / 180 * (bounds.max - bounds.min).norm() / 2;
    }
    e.speed = std::max(e.speed, speed);
  }
  for (const Collider& c : plan.effects.colliders) e.speed = std::max(e.speed, c.motion.max_speed(0));
  e.grid_bytes = plan.path.isa ? vector_grid_bytes(e.blocks, occupied, s.dimension, real)
                               : plain_grid_bytes(e.blocks, s, real);
  double components = 0;
  for (const Attribute* a : plan.attributes) components += a->components;
  // The vectorised path sorts into the affine velocities' memory, which has nothing to keep at that time.
  const double sorting =
      plan.path.isa && s.transfer != Transfer::pic ? 12 * e.total_particles : 20 * e.total_particles + widest;
  const double writing = e.total_particles * writing_bytes(components);
  // The simulation goes on, and sorts, while a frame is written; seeding takes less and is over by then.
  e.peak_bytes = e.particle_bytes + e.grid_bytes + sorting + writing;
  e.disk_bytes = plan.frames() * e.total_particles * (kPointBytes + kAttributeComponentBytes * components);
  e.dt = s.cfl * s.cell_size / (e.speed + e.wave_speed);
  if (s.max_dt) e.dt = std::min(e.dt, *s.max_dt);
  e.steps = std::ceil(s.duration / e.dt);
  e.core_seconds = e.steps * step_ns * 1e-9;
  return e;
}

}  // namespace firn
