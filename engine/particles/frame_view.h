// A finished frame as the sinks see it: spans and numbers, nothing of the simulation behind them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace firn {

/// One per-particle quantity of a frame. Vectors have 3 components and matrices 9 (row-major) in every
/// dimension: in 2D and 1D the missing axes are zero, and one on the diagonal of F_E and F_P.
struct AttributeView {
  std::string name;    // as in the file: P, v, pscale, F_E, ...
  int components = 1;  // 1, 3 or 9
  /// Writes particles [first, first + out.size() / components) into `out`.
  std::function<void(std::size_t first, std::span<float> out)> copy;
};

/// The sums over all particles of one frame, in double, added in an order that does not depend on threads.
/// SI units; in 2D per metre of thickness, in 1D per square metre of section.
struct FrameTotals {
  double mass = 0;              // kg
  double momentum[3] = {};      // kg m/s
  double angular[3] = {};       // kg m^2/s about the origin, the affine part included
  double kinetic = 0;           // J, the affine part included
  double elastic = 0;           // J
  double gravity = 0;           // J, potential, zero at the origin
  double dissipated = 0;        // J taken out by return maps since t = 0
  double max_speed = 0;         // m/s
  double min_J = 1, max_J = 1;  // det F_E F_P
};

/// How the frame was reached from the one before it.
struct FrameSteps {
  std::int64_t steps = 0;
  double dt_min = 0, dt_max = 0;  // s; 0 when no step was taken
};

struct FrameView {
  int frame = 1;    // 1 is t = 0
  double time = 0;  // s
  std::size_t particles = 0;
  std::function<void(std::size_t first, std::span<std::int64_t> out)> copy_id;
  std::vector<AttributeView> attributes;  // P first
  FrameTotals totals;
  FrameSteps steps;
  /// Every clamp and cut since the previous frame: name and count.
  std::vector<std::pair<std::string, std::int64_t>> counters;
};

}  // namespace firn
