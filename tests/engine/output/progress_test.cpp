#include "engine/output/progress.h"

#include <limits>
#include <sstream>

#include <catch2/catch.hpp>

#include "engine/output/quantities.h"

namespace firn {
namespace {

Progress::Settings settings(bool is_terminal) {
  return {.is_terminal = is_terminal,
          .columns = 200,
          .first_frame = 1,
          .last_frame = 101,
          .particles = 1'000'000};
}

}  // namespace

TEST_CASE("without a terminal progress is one plain line a frame") {
  std::ostringstream out;
  Progress progress(out, settings(false));
  progress.frame_done({.frame = 1, .written_bytes = 21'700'000, .seconds = 0.5});
  progress.step({.frame = 2, .fraction = 0.5, .dt = 1e-4, .steps = 20, .seconds = 2});
  progress.frame_done({.frame = 2, .dt = 1.2e-4, .steps = 40, .written_bytes = 43'400'000, .seconds = 4.5});
  progress.frame_done({.frame = 3, .dt = 2e-4, .steps = 60, .written_bytes = 65'100'000, .seconds = 6.5});
  progress.finish();
  CHECK(out.str() ==
        "frame 1/101  estimating time  21.7 MB written\n"
        "frame 2/101  dt 0.00012 s  40 steps  10.00 M particles/s  6 min 36 s left  43.4 MB written\n"
        "frame 3/101  dt 0.0002 s  20 steps  10.00 M particles/s  4 min 54 s left  65.1 MB written\n");
}

TEST_CASE("on a terminal progress redraws one line") {
  std::ostringstream out;
  Progress progress(out, settings(true));
  progress.step({.frame = 2, .fraction = 0.1, .dt = 1e-4, .steps = 5, .seconds = 1});
  progress.step({.frame = 2, .fraction = 0.1, .dt = 1e-4, .steps = 6, .seconds = 1.05});  // too soon
  progress.frame_done({.frame = 2, .dt = 1e-4, .steps = 40, .seconds = 3});
  progress.finish();
  progress.finish();
  CHECK(out.str() ==
        "\rframe 2/101  dt 0.0001 s  5 steps  5.00 M particles/s  estimating time  0 B written\x1b[K"
        "\rframe 2/101  dt 0.0001 s  40 steps  13.33 M particles/s  4 min 57 s left  0 B written\x1b[K\n");
}

TEST_CASE(
    "on a terminal progress does not go back to a frame that is written while the next one is computed") {
  std::ostringstream out;
  Progress progress(out, settings(true));
  progress.step({.frame = 3, .fraction = 0.1, .dt = 1e-4, .steps = 41, .seconds = 3.1});
  out.str("");
  progress.frame_done({.frame = 2, .dt = 1e-4, .steps = 40, .written_bytes = 1000, .seconds = 3});
  CHECK(out.str().empty());
  progress.step({.frame = 3, .dt = 1e-4, .steps = 50, .written_bytes = 1000, .seconds = 4});
  CHECK(out.str() ==
        "\rframe 3/101  dt 0.0001 s  10 steps  10.00 M particles/s  4 min 57 s left  1.0 kB written\x1b[K");
}

TEST_CASE("progress never draws wider than the terminal") {
  std::ostringstream out;
  auto narrow = settings(true);
  narrow.columns = 20;
  Progress progress(out, narrow);
  progress.step({.frame = 2, .fraction = 0.1, .dt = 1e-4, .steps = 5, .seconds = 1});
  CHECK(out.str() == "\rframe 2/101  dt 0.0\x1b[K");
}

TEST_CASE("the time left is guessed in the first frame only after a while, and follows a changing cost") {
  std::ostringstream out;
  Progress progress(out, settings(true));
  progress.step({.frame = 2, .fraction = 0.01, .dt = 1e-4, .steps = 1, .seconds = 0.5});
  CHECK(out.str().find("estimating") != std::string::npos);
  out.str("");
  progress.step({.frame = 2, .fraction = 0.5, .dt = 1e-4, .steps = 9, .seconds = 5});
  CHECK(out.str().find("  16 min 35 s left") != std::string::npos);  // 10 s a frame, 99.5 to go
  double seconds = 0;
  for (int frame = 2; frame <= 51; ++frame) {
    seconds += frame < 40 ? 10 : 2;
    out.str("");
    progress.frame_done({.frame = frame, .dt = 1e-4, .steps = 10 * frame, .seconds = seconds});
  }
  CHECK(out.str().find("  1 min 40 s left") != std::string::npos);  // 50 frames of 2 s
}

TEST_CASE("the last frame says how long the run took") {
  std::ostringstream out;
  Progress progress(out, settings(false));
  progress.frame_done({.frame = 101, .dt = 1e-4, .steps = 10, .seconds = 3700});
  CHECK(out.str().find("  done in 1 h 01 min  ") != std::string::npos);
}

TEST_CASE("sizes and times are written as people read them") {
  CHECK(readable_bytes(0) == "0 B");
  CHECK(readable_bytes(999) == "999 B");
  CHECK(readable_bytes(999'949) == "999.9 kB");
  CHECK(readable_bytes(999'950) == "1.0 MB");
  CHECK(readable_bytes(std::numeric_limits<std::uint64_t>::max()) == "18.4 EB");
  CHECK(readable_seconds(59.6) == "1 min 00 s");
  CHECK(readable_seconds(86'400 + 7200) == "1 d 2 h");
  CHECK(readable_seconds(-1) == "?");
  CHECK(readable_seconds(std::numeric_limits<double>::quiet_NaN()) == "?");
}

}  // namespace firn
