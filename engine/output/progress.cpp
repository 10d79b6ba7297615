#include "engine/output/progress.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "engine/output/quantities.h"

namespace firn {
namespace {

constexpr double kRedrawSeconds = 0.1;
constexpr std::size_t kFramesRemembered = 8;  // follows a changing cost, does not follow noise
constexpr double kFirstEstimateSeconds = 2;   // before that a first frame says little about the rest

}  // namespace

Progress::Progress(std::ostream& out, const Settings& settings) : out_(out), settings_(settings) {
  last_frame_state_.frame = settings.first_frame - 1;
}

void Progress::step(const State& state) {
  if (!settings_.is_terminal || state.seconds < drawn_at_ + kRedrawSeconds) return;
  draw(state);
}

void Progress::frame_done(const State& done) {
  State state = done;
  state.fraction = 1;
  // The initial state costs nothing to simulate and would make the rest look cheap.
  if (state.steps > last_frame_state_.steps) {
    frame_seconds_.push_back(state.seconds - last_frame_state_.seconds);
    if (frame_seconds_.size() > kFramesRemembered) frame_seconds_.pop_front();
  }
  if (settings_.is_terminal) {
    if (state.frame >= drawn_frame_) draw(state);
  } else {
    out_ << line(state) << '\n' << std::flush;
  }
  last_frame_state_ = state;
}

void Progress::finish() {
  if (line_open_) out_ << '\n' << std::flush;
  line_open_ = false;
}

void Progress::draw(const State& state) {
  // One column less than there are: a full line would wrap on some terminals.
  const auto width = static_cast<std::size_t>(std::max(settings_.columns - 1, 1));
  out_ << '\r' << line(state).substr(0, width) << "\x1b[K" << std::flush;
  drawn_at_ = state.seconds;
  drawn_frame_ = state.frame;
  line_open_ = true;
}

double Progress::frames_to_go(const State& state) const {
  return std::max(0.0, settings_.last_frame - state.frame + (1 - state.fraction));
}

std::string Progress::time_left(const State& state) const {
  const double to_go = frames_to_go(state);
  if (to_go == 0) return "done in " + readable_seconds(state.seconds);
  double per_frame = 0;
  if (!frame_seconds_.empty()) {
    const double sum = std::accumulate(frame_seconds_.begin(), frame_seconds_.end(), 0.0);
    per_frame = sum / static_cast<double>(frame_seconds_.size());
  } else if (state.fraction > 0 && state.seconds - last_frame_state_.seconds >= kFirstEstimateSeconds) {
    per_frame = (state.seconds - last_frame_state_.seconds) / state.fraction;
  } else {
    return "estimating time";
  }
  return readable_seconds(per_frame * to_go) + " left";
}

std::string Progress::line(const State& state) const {
  // Over the frame under way, or the one just finished: what the machine does now.
  const auto steps = state.steps - last_frame_state_.steps;
  const double seconds = state.seconds - last_frame_state_.seconds;
  std::string out = fmt::format("frame {}/{}", state.frame, settings_.last_frame);
  if (steps > 0) out += fmt::format("  dt {:.2g} s  {} steps", state.dt, steps);
  if (steps > 0 && seconds > 0) {
    const double rate = static_cast<double>(settings_.particles) * static_cast<double>(steps) / seconds;
    out += fmt::format("  {:.2f} M particles/s", rate * 1e-6);
  }
  return out + fmt::format("  {}  {} written", time_left(state), readable_bytes(state.written_bytes));
}

}  // namespace firn
