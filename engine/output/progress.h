// What a run shows while it goes on: one line that redraws itself on a terminal, one plain line a frame
// anywhere else (a log, a pipe). It keeps no clock of its own: the caller says how many seconds have passed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <ostream>
#include <string>
#include <utility>

namespace firn {

class Progress {
 public:
  struct Settings {
    bool is_terminal = false;
    int columns = 80;     // of the terminal
    int first_frame = 1;  // of this run; frame 1 is the initial state
    int last_frame = 1;
    std::size_t particles = 0;
  };

  /// What happened up to now. `steps` and `written_bytes` count from the start of the run, `seconds` is the
  /// time spent.
  struct State {
    int frame = 1;        // the frame under way, or just finished
    double fraction = 0;  // of it, simulated: 0..1
    double dt = 0;        // s, of the last step
    std::int64_t steps = 0;
    std::uint64_t written_bytes = 0;
    double seconds = 0;
  };

  Progress(std::ostream& out, const Settings& settings);

  /// May be called after every step: draws at most ten times a second, and nothing when not on a terminal.
  void step(const State& state);
  /// In the order of the frames. Steps of later ones may have been shown already: the line on a terminal does
  /// not go back then.
  void frame_done(const State& state);
  /// Ends the redrawn line, so that what is printed next starts on a line of its own. May be called more than
  /// once.
  void finish();

 private:
  std::string line(const State& state) const;
  double frames_to_go(const State& state) const;
  std::string time_left(const State& state) const;
  void draw(const State& state);

  std::ostream& out_;
  Settings settings_;
  double drawn_at_ = -1;  // s
  int drawn_frame_ = 0;
  bool line_open_ = false;
  State last_frame_state_;
  std::deque<double> frame_seconds_;  // of the latest frames: what the next ones will take
};

}  // namespace firn
