// The frames of a run, one after the other.
#pragma once

#include <functional>
#include <span>

#include "engine/simulation/simulation.h"

namespace firn {

/// Gets every frame from `first` on; throws to end the run.
using FrameSink = std::function<void(const FrameView&)>;
/// Asked before every step; true ends the run at once, with the frames so far whole.
using StopRequested = std::function<bool()>;
/// Told after every step: frame being computed, time, dt.
using StepListener = std::function<void(int frame, double time, double dt)>;

/// Frames 1 (t = 0) to `last`, of which `first` and later go to the sinks. False when it was stopped.
bool run_frames(Simulation& simulation, double frame_rate, int first, int last,
                std::span<const FrameSink> sinks, const StepListener& listener, const StopRequested& stop);

}  // namespace firn
