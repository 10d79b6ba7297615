#include "tools/cli/run_output.h"

#include <iostream>

#include <fmt/format.h>

#include "engine/output/content_hash.h"
#include "engine/simulation/simulation.h"

namespace firn {
namespace {

Diagnostics fresh_diagnostics(OutputFolder& folder) {
  folder.remove_earlier_run();
  return {folder.path() / "diagnostics.csv", {kCounters.begin(), kCounters.end()}};
}

}  // namespace

RunOutput::RunOutput(OutputFolder& folder, const PointCacheSettings& cache,
                     const Progress::Settings& progress, Clock::time_point start)
    : folder_(folder),
      cache_(cache),
      last_frame_(progress.last_frame),
      start_(start),
      diagnostics_(fresh_diagnostics(folder)),
      progress_(std::cerr, progress),
      writer_([this](const FrameView& frame) { write_to_disk(frame); }) {}

void RunOutput::stepped(int frame, double time, double dt) {
  ++steps_;
  dt_ = dt;
  const std::lock_guard lock(mutex_);
  progress_.step({.frame = frame,
                  .fraction = 1 - ((frame - 1) - time * cache_.frame_rate),
                  .dt = dt,
                  .steps = steps_,
                  .written_bytes = written_bytes_,
                  .seconds = seconds()});
}

void RunOutput::write(const FrameView& frame) {
  {
    const std::lock_guard lock(mutex_);
    simulated_.push_back({.frame = frame.frame, .dt = dt_, .steps = steps_, .seconds = seconds()});
  }
  writer_.push(frame);
}

void RunOutput::finish() {
  try {
    writer_.finish();
  } catch (...) {
    progress_.finish();
    throw;
  }
  progress_.finish();
}

void RunOutput::write_to_disk(const FrameView& frame) {
  const auto file = folder_.frame_file(frame.frame);
  const std::uint64_t bytes = write_point_cache(file, frame, cache_);
  diagnostics_.append(frame);
  frames_.push_back({{"frame", frame.frame},
                     {"time", frame.time},
                     {"file", file.filename().string()},
                     {"bytes", bytes},
                     {"content_xxh3", fmt::format("{:016x}", content_hash(frame))}});
  show_written(frame.frame, bytes);
}

void RunOutput::show_written(int frame, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  written_bytes_ += bytes;
  Progress::State state = simulated_.front();
  simulated_.pop_front();
  state.written_bytes = written_bytes_;
  // Between frames what counts is how fast they are simulated; the last one ends the run when it is written.
  if (frame == last_frame_) state.seconds = seconds();
  progress_.frame_done(state);
}

}  // namespace firn
