#include "engine/output/frame_writer.h"

#include <atomic>
#include <chrono>
#include <new>
#include <set>
#include <string>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/support/sample_frame.h"

namespace firn {
namespace {

using std::chrono::milliseconds;
using testing::SampleFrame;

constexpr std::size_t kParticles = 5000;  // two tasks of the copy
// A push that should wait gets this long to return by mistake; one that should not has no limit.
constexpr milliseconds kLongEnough{100};

FrameView numbered(const SampleFrame& sample, int frame) {
  FrameView view = sample.view();
  view.frame = frame;
  return view;
}

/// What a sink waits for.
class Gate {
 public:
  void open() {
    open_ = true;
    open_.notify_all();
  }
  void wait() { open_.wait(false); }

 private:
  std::atomic<bool> open_ = false;
};

/// A sink that waits at the gate and then remembers the frames it got.
struct Recorder {
  Gate& gate;
  std::vector<int>& frames;
  int fails_at = 0;
  void operator()(const FrameView& frame) const {
    gate.wait();
    frames.push_back(frame.frame);
    if (frame.frame == fails_at) throw Error(ExitCode::io, "disk full at frame " + std::to_string(fails_at));
  }
};

/// Pushes frames 1 to `last` on a thread of its own and counts those that were accepted.
class Pusher {
 public:
  Pusher(FrameWriter& writer, int last) : thread_([this, &writer, last] { push(writer, last); }) {}
  ~Pusher() {
    if (thread_.joinable()) thread_.join();
  }
  void wait_for(int count) const {
    for (int now = accepted_; now < count; now = accepted_) accepted_.wait(now);
  }
  int accepted() const { return accepted_; }
  /// What ended it early.
  std::exception_ptr join() {
    thread_.join();
    return failure_;
  }

 private:
  void push(FrameWriter& writer, int last) {
    const SampleFrame sample(kParticles);
    try {
      for (int frame = 1; frame <= last; ++frame) {
        writer.push(numbered(sample, frame));
        accepted_ = frame;
        accepted_.notify_all();
      }
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  std::atomic<int> accepted_ = 0;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace

TEST_CASE("frames reach the sink in order, each as it was when it was pushed") {
  SampleFrame sample(kParticles);
  std::vector<std::pair<int, std::vector<float>>> got;
  FrameWriter writer([&](const FrameView& frame) {
    std::vector<float> positions(3 * frame.particles);
    frame.attributes[0].copy(0, positions);
    got.emplace_back(frame.frame, std::move(positions));
  });
  std::vector<std::pair<int, std::vector<float>>> pushed;
  for (int frame = 1; frame <= 30; ++frame) {
    std::fill(sample.P.begin(), sample.P.end(), static_cast<float>(frame));
    pushed.emplace_back(frame, sample.P);
    writer.push(numbered(sample, frame));
  }
  writer.finish();
  CHECK((got == pushed));
}

TEST_CASE("the sink works on another thread, while the one that pushes goes on") {
  Gate gate;
  std::thread::id there;
  FrameWriter writer([&](const FrameView&) {
    there = std::this_thread::get_id();
    gate.wait();
  });
  writer.push(SampleFrame(kParticles).view());  // would hang otherwise
  gate.open();
  writer.finish();
  CHECK(there != std::this_thread::get_id());
}

TEST_CASE("a push waits while the queue is full, and its wait is counted") {
  const int waiting = GENERATE(1, 3);
  std::vector<int> written;
  std::set<const FrameView*> snapshots;
  Gate gate;
  FrameWriter writer(
      [&](const FrameView& frame) {
        snapshots.insert(&frame);
        Recorder{gate, written}(frame);
      },
      static_cast<std::size_t>(waiting));
  Pusher pusher(writer, 10);
  pusher.wait_for(waiting + 1);
  std::this_thread::sleep_for(kLongEnough);
  CHECK(pusher.accepted() == waiting + 1);
  gate.open();
  CHECK(pusher.join() == nullptr);
  writer.finish();
  CHECK(written == std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  CHECK(snapshots.size() <= static_cast<std::size_t>(waiting) + 1);
  // The clocks of two threads and of the sleep may disagree a little.
  const double least = 0.9 * std::chrono::duration<double>(kLongEnough).count();
  CHECK(writer.times().wait >= least);
  CHECK(writer.times().sink >= least);
  CHECK(writer.times().snapshot > 0);
}

TEST_CASE("finish counts as waiting what it waits for the last frames") {
  FrameWriter writer([](const FrameView&) { std::this_thread::sleep_for(kLongEnough); });
  writer.push(SampleFrame(kParticles).view());
  const double before = writer.times().wait;
  writer.finish();
  CHECK(writer.times().wait - before >= 0.5 * std::chrono::duration<double>(kLongEnough).count());
}

TEST_CASE(
    "what the sink throws comes out of push and finish with its type, and nothing is written after it") {
  Gate gate;
  std::vector<int> written;
  FrameWriter writer(Recorder{gate, written, 2});
  gate.open();
  const SampleFrame sample(kParticles);
  writer.push(numbered(sample, 1));
  writer.push(numbered(sample, 2));
  while (!writer.failed()) std::this_thread::yield();
  for (int attempt = 0; attempt < 3; ++attempt) {
    try {
      attempt == 1 ? writer.finish() : writer.push(numbered(sample, 3));
      FAIL("it went unnoticed");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::io);
      CHECK(std::string(error.what()) == "disk full at frame 2");
    }
  }
  CHECK(written == std::vector<int>{1, 2});
}

TEST_CASE("a failure wakes a push that waits, and frames in the queue are dropped") {
  std::vector<int> written;
  Gate gate;
  FrameWriter writer(Recorder{gate, written, 1});
  Pusher pusher(writer, 3);
  pusher.wait_for(2);
  std::this_thread::sleep_for(kLongEnough);  // the third waits now
  gate.open();
  const std::exception_ptr failure = pusher.join();
  REQUIRE(failure != nullptr);
  CHECK_THROWS_AS(std::rethrow_exception(failure), Error);
  CHECK(pusher.accepted() == 2);
  CHECK_THROWS_AS(writer.finish(), Error);
  CHECK(written == std::vector<int>{1});
}

TEST_CASE("finish reports a failure of the last frame") {
  FrameWriter writer([](const FrameView&) { throw std::bad_alloc(); });
  writer.push(SampleFrame(kParticles).view());
  CHECK_THROWS_AS(writer.finish(), std::bad_alloc);
}

TEST_CASE("a writer that goes out of scope writes what is pending") {
  std::vector<int> written;
  Gate gate;
  std::thread opens;
  {
    FrameWriter writer(Recorder{gate, written});
    const SampleFrame sample(kParticles);
    writer.push(numbered(sample, 1));
    writer.push(numbered(sample, 2));
    opens = std::thread([&] {
      std::this_thread::sleep_for(kLongEnough);
      gate.open();
    });
  }
  opens.join();
  CHECK(written == std::vector<int>{1, 2});
}

TEST_CASE("a writer that goes out of scope after a failure neither throws nor writes") {
  std::vector<int> written;
  Gate gate;
  std::thread opens;
  {
    FrameWriter writer(Recorder{gate, written, 1});
    const SampleFrame sample(kParticles);
    writer.push(numbered(sample, 1));
    writer.push(numbered(sample, 2));
    opens = std::thread([&] {
      std::this_thread::sleep_for(kLongEnough);
      gate.open();
    });
  }
  opens.join();
  CHECK(written == std::vector<int>{1});
}

TEST_CASE("a frame that cannot be copied is reported at once and costs the queue no room") {
  std::vector<int> written;
  Gate gate;
  gate.open();
  FrameWriter writer(Recorder{gate, written});
  const SampleFrame sample(kParticles);
  FrameView broken = numbered(sample, 1);
  broken.copy_id = [](std::size_t, std::span<std::int64_t>) { throw std::bad_alloc(); };
  for (int attempt = 0; attempt < 5; ++attempt) CHECK_THROWS_AS(writer.push(broken), std::bad_alloc);
  writer.push(numbered(sample, 2));
  writer.finish();
  CHECK(written == std::vector<int>{2});
}

}  // namespace firn
