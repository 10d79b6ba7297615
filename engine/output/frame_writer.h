// Hands frames to a sink on a thread of its own, so that the next frame is computed while this one is
// written. The queue is bounded: when the sink is slower than the simulation, the simulation waits.
//
// All functions are for the one thread that pushes.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/particles/frame_snapshot.h"

namespace firn {

class FrameWriter {
 public:
  using Sink = std::function<void(const FrameView&)>;

  /// Seconds since the start.
  struct Times {
    double snapshot = 0;  // copying frames, on the thread that pushes
    double wait = 0;      // that thread waited for the sink: what writing costs the run
    double sink = 0;      // the sink worked
  };

  /// `waiting`: frames that may wait while one is written; there are never more than `waiting` + 1 snapshots.
  /// Throws Error{ExitCode::resources} when the system grants no thread.
  explicit FrameWriter(Sink sink, std::size_t waiting = 1);
  /// finish(), except that a failure of the sink goes unnoticed.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  /// Copies `frame` and returns; waits first while the queue is full.
  /// Throws what the sink threw first, in this call and every later one. The sink got no frame after that one
  /// and gets none, not even those in the queue.
  void push(const FrameView& frame);

  /// Returns when the sink is done with every frame; there can be no push after it. Throws as push does.
  void finish();

  /// The sink threw: the next push() or finish() will.
  bool failed() const;

  Times times() const;

 private:
  std::unique_ptr<FrameSnapshot> next_free();
  void write_frames();
  std::exception_ptr write(const FrameView& frame);
  [[noreturn]] void rethrow_failure();

  const Sink sink_;

  mutable std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  // The one used last is taken first: it is still in the cache, and where writing is quick the others never
  // grow.
  std::vector<std::unique_ptr<FrameSnapshot>> free_;
  std::deque<std::unique_ptr<FrameSnapshot>> waiting_;
  bool finishing_ = false;
  std::exception_ptr failure_;
  Times times_;

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace firn
