// A seeded scene that can be stepped and looked at. One implementation for every dimension, precision and
// transfer scheme, chosen once from the plan.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/particles/frame_view.h"
#include "engine/scene/plan.h"
#include "engine/scene/seeding.h"

namespace firn {

/// Seconds spent in each pass since the start.
struct PassTimes {
  enum Pass { sort, p2g, grid, g2p, material, count };
  static constexpr std::array<std::string_view, count> names{"sort", "p2g", "grid", "g2p", "material"};
  std::array<double, count> seconds{};
};

/// What one part of the simulation has cost since the start.
struct Cost {
  std::string part;  // "sort", "transfer", "gravity", ...; of a material or a collider its name in the scene
  std::string_view kind;    // "material", "collider", or empty
  std::string_view passes;  // where it is computed
  double seconds;           // wall time; of parts of one pass by their share in blocks that were measured
  std::size_t bytes;
};

/// What a frame's counters count; `capped`: particle updates on which a cap of the material model acted;
/// `ignored_nodes`: nodes lighter than simulation.mass_cutoff allows.
inline constexpr std::array<const char*, 2> kCounters{"capped", "ignored_nodes"};

/// Every particle in double, by its id: the order of the seeds, body after body. For comparisons; caches are
/// written from a FrameView.
struct MaterialPoints {
  explicit MaterialPoints(std::size_t n)
      : position(n, Vec3::Zero()), velocity(n, Vec3::Zero()), stress(n, Eigen::Matrix3d::Zero()), mass(n) {}

  std::vector<Vec3> position, velocity;  // m, m/s
  std::vector<Eigen::Matrix3d> stress;   // Pa, Cauchy's, positive in tension; 0 on axes that are missing
  std::vector<double> mass;              // kg
};

class Simulation {
 public:
  virtual ~Simulation() = default;

  /// The largest stable step from here, s: cfl h / (|v| + c), with the fastest particle or collider and the
  /// fastest P-wave of the deformed, hardened material.
  virtual double stable_dt() const = 0;

  /// Advances by `dt`. Throws Error{numerics} naming a particle when the state is no longer finite; the state
  /// before it is then lost, and frames already written are not touched.
  ///
  /// `next`: the length of the step to follow, when it is to follow without a look at the particles (view) in
  /// between, else 0. A path that fuses two steps already puts the next one's forces on the grid; it must
  /// then be that long, unless `shorten` says otherwise first.
  virtual void step(double dt, double next = 0) = 0;
  /// Makes the announced next step `next` instead.
  virtual void shorten(double next) = 0;

  virtual double time() const = 0;
  /// After the last step of a frame, the time it was meant to reach: sums of steps do not drift.
  virtual void set_time(double time) = 0;

  /// Particles, totals and counters as they stand; valid until the next step. The counters start again at
  /// zero.
  virtual FrameView view() = 0;

  /// As view() sees them.
  virtual MaterialPoints material_points() const = 0;

  virtual std::size_t particles() const = 0;
  /// Steps so far that sorted, blocks in use and those of them with particles, bytes held by particles and
  /// grid.
  virtual std::size_t sorts() const = 0;
  virtual std::size_t blocks() const = 0;
  virtual std::size_t occupied_blocks() const = 0;
  virtual std::size_t bytes() const = 0;
  virtual const PassTimes& times() const = 0;
  virtual std::vector<Cost> costs() const = 0;
};

/// `seeds`: one per body of the plan.
std::unique_ptr<Simulation> make_simulation(const Plan& plan, std::span<const Seeds> seeds);

}  // namespace firn
