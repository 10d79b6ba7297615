// What a run leaves behind and shows while it goes on: frames and diagnostics, written by a thread of their
// own, and progress, which both that thread and the simulation report.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>

#include <nlohmann/json.hpp>

#include "engine/output/diagnostics.h"
#include "engine/output/frame_writer.h"
#include "engine/output/output_folder.h"
#include "engine/output/point_cache.h"
#include "engine/output/progress.h"

namespace firn {

class RunOutput {
 public:
  using Clock = std::chrono::steady_clock;

  /// Removes what an earlier run left in `folder`. Times shown count from `start`.
  RunOutput(OutputFolder& folder, const PointCacheSettings& cache, const Progress::Settings& progress,
            Clock::time_point start);

  /// After every step: frame being computed, its time, dt.
  void stepped(int frame, double time, double dt);
  /// Hands a frame over; throws what writing an earlier one threw.
  void write(const FrameView& frame);
  /// Writing failed; write() or finish() will throw.
  bool failed() const { return writer_.failed(); }
  /// Returns when all frames are on disk or writing has failed, and ends the line of progress. Throws what
  /// writing threw.
  void finish();

  std::int64_t steps() const { return steps_; }
  /// After finish().
  const nlohmann::json& frames() const { return frames_; }
  std::uint64_t written_bytes() const { return written_bytes_; }
  FrameWriter::Times times() const { return writer_.times(); }

 private:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  void write_to_disk(const FrameView& frame);
  void show_written(int frame, std::uint64_t bytes);

  OutputFolder& folder_;
  const PointCacheSettings cache_;
  const int last_frame_;
  const Clock::time_point start_;

  // The thread that simulates:
  std::int64_t steps_ = 0;
  double dt_ = 0;  // s, of the last step

  // The thread that writes, until it is done:
  Diagnostics diagnostics_;
  nlohmann::json frames_ = nlohmann::json::array();

  std::mutex mutex_;  // of what follows
  Progress progress_;
  std::deque<Progress::State> simulated_;  // frames not yet written, as they stood when handed over
  std::uint64_t written_bytes_ = 0;

  FrameWriter writer_;  // last: its thread uses all of the above
};

}  // namespace firn
