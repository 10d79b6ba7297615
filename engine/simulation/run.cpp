#include "engine/simulation/run.h"

namespace firn {
namespace {

/// Steps to exactly `target`; the last two share what is left, so that none is tiny.
bool advance(Simulation& simulation, double target, int frame, const StepListener& listener,
             const StopRequested& stop) {
  // What remains below this is rounding of the time itself.
  const double nothing = 1e-12 * target;
  while (target - simulation.time() > nothing) {
    if (stop()) return false;
    const double left = target - simulation.time();
    double dt = simulation.stable_dt();
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
    if (!advance(simulation, (frame - 1) / frame_rate, frame, listener, stop)) return false;
    if (frame < first) continue;
    FrameView view = simulation.view();
    view.frame = frame;
    for (const FrameSink& sink : sinks) sink(view);
  }
  return true;
}

}  // namespace firn
