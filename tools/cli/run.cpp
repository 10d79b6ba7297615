#include "tools/cli/run.h"

#include <charconv>
#include <chrono>
#include <csignal>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/ioctl.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/output/json_file.h"
#include "engine/output/output_folder.h"
#include "engine/scene/estimate.h"
#include "engine/scene/reader.h"
#include "engine/scene/seed_check.h"
#include "engine/simulation/run.h"
#include "tools/cli/costs.h"
#include "tools/cli/memory.h"
#include "tools/cli/plan.h"
#include "tools/cli/run_output.h"
#include "tools/cli/units.h"
#include "tools/cli/version.h"

namespace firn {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

volatile std::sig_atomic_t g_signal = 0;
extern "C" void remember_signal(int signal) {
  g_signal = signal;
}

struct FrameRange {
  int first, last;
};

FrameRange parse_frames(const std::string& text, int frames) {
  FrameRange range{1, frames};
  if (text.empty()) return range;
  const auto wrong = [&] {
    return Error(ExitCode::input,
                 fmt::format("--frames {}: expected A:B, A: or :B with 1 <= A <= B <= {}", text, frames));
  };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw wrong();
  const auto number = [&](std::string_view part, int& out) {
    if (part.empty()) return;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), out);
    if (error != std::errc() || end != part.data() + part.size()) throw wrong();
  };
  number(std::string_view(text).substr(0, colon), range.first);
  number(std::string_view(text).substr(colon + 1), range.last);
  if (range.first < 1 || range.first > range.last || range.last > frames) throw wrong();
  return range;
}

void check_memory(const Estimate& e, std::uint64_t limit) {
  const auto available = static_cast<double>(limit > 0 ? limit : available_memory());
  if (e.peak_bytes <= available) return;
  throw Error(
      ExitCode::resources,
      fmt::format("needs about {} for {} particles, {} are available; about {} particles would fit: raise "
                  "simulation.cell_size by a factor of {:.2f} or lower particles_per_cell",
                  bytes_text(e.peak_bytes), grouped(e.total_particles), bytes_text(available),
                  grouped(e.total_particles * available / e.peak_bytes),
                  std::cbrt(e.peak_bytes / available)));
}

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

struct RunTimes {
  Clock::time_point start = Clock::now();
  double seeding = 0;  // s
};

/// `output` after its finish().
nlohmann::json run_record(const Plan& plan, const Estimate& e, const Simulation& simulation,
                          const RunOutput& output, const RunTimes& times, int threads,
                          std::string_view state) {
  nlohmann::json passes;
  double stepping = 0;
  for (int p = 0; p < PassTimes::count; ++p) {
    const double seconds = simulation.times().seconds[static_cast<std::size_t>(p)];
    passes[std::string(PassTimes::names[static_cast<std::size_t>(p)])] = seconds;
    stepping += seconds;
  }
  const double updates = static_cast<double>(simulation.particles()) * static_cast<double>(output.steps());
  const FrameWriter::Times writing = output.times();
  return {{"versions", {{"firn", kVersion}, {"compiler", __VERSION__}}},
          {"scene", plan.scene.as_run},
          {"state", state},
          {"plan", plan_json(plan, e)},
          {"threads", threads},
          {"particles", simulation.particles()},
          {"steps", output.steps()},
          {"sorts", simulation.sorts()},
          {"seconds",
           {{"total", seconds_since(times.start)},
            {"seeding", times.seeding},
            {"snapshot", writing.snapshot},
            {"output_wait", writing.wait},
            {"output", writing.sink},  // while the passes run, but for output_wait
            {"passes", passes}}},
          {"particle_updates_per_second", stepping > 0 ? updates / stepping : 0},
          {"bytes", simulation.bytes()},
          {"costs", costs_json(plan, simulation, output.steps(), writing)},
          {"frames", output.frames()}};
}

/// False when a signal stopped it. Every frame that was simulated is on disk then, and also when the
/// simulation throws; when writing fails that is what it throws, since the frame concerned came first.
bool simulate(Simulation& simulation, double rate, FrameRange range, RunOutput& output) {
  const FrameSink sink = [&](const FrameView& frame) { output.write(frame); };
  const StepListener listener = [&](int frame, double time, double dt) { output.stepped(frame, time, dt); };
  const StopRequested stop = [&] { return g_signal != 0 || output.failed(); };
  bool finished = false;
  try {
    finished = run_frames(simulation, rate, range.first, range.last, {&sink, 1}, listener, stop);
  } catch (...) {
    output.finish();
    throw;
  }
  output.finish();
  return finished;
}

}  // namespace

int run_scene(const RunOptions& options) {
  RunTimes times;
  const int threads = options.threads > 0 ? options.threads : default_threads();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));

  const Plan plan = make_plan(read_scene(options.scene, options.overrides));
  const FrameRange range = parse_frames(options.frames, plan.frames());
  const Estimate e = estimate(plan);
  check_memory(e, options.max_memory);

  const auto folder_path =
      options.out.empty() ? std::filesystem::path("out") / options.scene.stem() : options.out;
  OutputFolder folder(folder_path, {options.overwrite, static_cast<std::uint64_t>(e.disk_bytes)});
  std::vector<std::string> warnings = plan.warnings;
  if (!folder.warning().empty()) warnings.push_back(folder.warning());

  const Clock::time_point seeding = Clock::now();
  const std::unique_ptr<Simulation> simulation = make_simulation(plan, seed_bodies(plan, warnings));
  times.seeding = seconds_since(seeding);
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';

  g_signal = 0;
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  const double rate = plan.scene.simulation.frame_rate;
  RunOutput output(folder, {plan.cell_size(), rate, std::string("firn ") + kVersion},
                   {isatty(STDERR_FILENO) != 0, terminal_columns(), 1, range.last, simulation->particles()},
                   times.start);
  const auto record = [&](std::string_view state) {
    write_json(folder.path() / "run.json", run_record(plan, e, *simulation, output, times, threads, state));
  };

  bool finished = false;
  try {
    finished = simulate(*simulation, rate, range, output);
  } catch (const Error& error) {
    if (error.code() == ExitCode::numerics) record("stopped: numerics");
    throw;
  }
  record(finished ? "finished" : "stopped by a signal");
  const nlohmann::json summary = run_record(plan, e, *simulation, output, times, threads, "");
  std::cerr << fmt::format(
      "{} {} frames, {} particles, {} steps in {}: {:.2f} M particle updates/s; {} in {}\n",
      finished ? "finished:" : "stopped:", output.frames().size(),
      grouped(static_cast<double>(simulation->particles())), grouped(static_cast<double>(output.steps())),
      duration_text(seconds_since(times.start)), summary["particle_updates_per_second"].get<double>() / 1e6,
      bytes_text(static_cast<double>(output.written_bytes())), folder.path().string());
  if (output.steps() > 0) std::cerr << "cost: " << costs_line(summary["costs"]) << '\n';
  return finished ? 0 : 128 + g_signal;
}

}  // namespace firn
