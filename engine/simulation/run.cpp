#include "engine/simulation/run.h"

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

/// Steps to exactly `target`; the last two share what is left, so that none is tiny.
bool advance(Simulation& simulation, double target, double frame_duration, int frame,
             const StepListener& listener, const StopRequested& stop) {
  // What remains below this is rounding of the time itself.
  const double nothing = 1e-12 * target;
  while (target - simulation.time() > nothing) {
    if (stop()) return false;
    const double left = target - simulation.time();
    double dt = simulation.stable_dt();
    check_step(dt, frame_duration, simulation.time());
    if (left <= dt)
      dt = left;
    else if (left < 2 * dt)
      dt = left / 2;
    simulation.step(dt);
    listener(frame, simulation.time(), dt);
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
