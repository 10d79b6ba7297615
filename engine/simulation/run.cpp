#include "engine/simulation/run.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace firn {
namespace {

// A frame that needs more steps than this is not slow but broken: no run of it would ever end.
constexpr double kMostStepsPerFrame = 1e6;

void check_step(double dt, double frame_duration, double time) {
  if (dt * kMostStepsPerFrame >= frame_duration) return;
  throw Error(
      ExitCode::numerics,
      fmt::format(
          "t = {:.6g} s: the stable time step has fallen to {:.3g} s, more than {:.0g} steps for a frame "
          "of {:.3g} s. Something moves too fast, or is too stiff, for its cell size; frames before it "
          "are whole.",
          time, dt, kMostStepsPerFrame, frame_duration));
}

/// A step of at most `dt` when `left` remains to the frame; the last two share it, so that none is tiny.
double fitted(double dt, double left) {
  if (left <= dt) return left;
  return left < 2 * dt ? left / 2 : dt;
}

// A step decided ahead may turn out this much longer than cfl asks for. cfl is a margin, not an edge.
constexpr double kTooLong = 1.05;

/// Steps to exactly `target`. The length of each step but a frame's first is decided before the one it
/// follows: what the speeds change by is extrapolated, and corrected when it was more.
bool advance(Simulation& simulation, double target, double frame_duration, int frame,
             const StepListener& listener, const StopRequested& stop) {
  // What remains below this is rounding of the time itself.
  const double nothing = 1e-12 * target;
  double left = target - simulation.time();
  if (left <= nothing) return true;
  double stable = simulation.stable_dt(), before = stable;
  double dt = fitted(stable, left);
  while (left > nothing) {
    if (stop()) return false;
    check_step(stable, frame_duration, simulation.time());
    const double left_after = left - dt;
    const double ahead = 1 / (1 / stable + std::max(0.0, 1 / stable - 1 / before));
    double next = left_after > nothing ? fitted(ahead, left_after) : 0;
    simulation.step(dt, next);
    listener(frame, simulation.time(), dt);
    before = std::exchange(stable, simulation.stable_dt());
    if (next > kTooLong * stable) {
      next = fitted(stable, left_after);
      simulation.shorten(next);
    }
    left = left_after;
    dt = next;
  }
  simulation.set_time(target);
  return true;
}

}  // namespace

bool run_frames(Simulation& simulation, double frame_rate, int first, int last,
                std::span<const FrameSink> sinks, const StepListener& listener, const StopRequested& stop) {
  for (int frame = 1; frame <= last; ++frame) {
    if (!advance(simulation, (frame - 1) / frame_rate, 1 / frame_rate, frame, listener, stop)) return false;
    if (frame < first) continue;
    FrameView view = simulation.view();
    view.frame = frame;
    for (const FrameSink& sink : sinks) sink(view);
  }
  return true;
}

}  // namespace firn
