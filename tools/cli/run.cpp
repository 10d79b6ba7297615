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
#include "engine/output/content_hash.h"
#include "engine/output/diagnostics.h"
#include "engine/output/json_file.h"
#include "engine/output/output_folder.h"
#include "engine/output/point_cache.h"
#include "engine/output/progress.h"
#include "engine/scene/estimate.h"
#include "engine/scene/reader.h"
#include "engine/scene/seed_check.h"
#include "engine/simulation/run.h"
#include "tools/cli/memory.h"
#include "tools/cli/plan.h"
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

std::unique_ptr<Simulation> seeded_simulation(const Plan& plan, std::vector<std::string>& warnings) {
  std::vector<Seeds> seeds;
  const SimulationDescription& s = plan.scene.simulation;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b)
    seeds.push_back(seed_body(plan.scene.bodies[b], plan.bodies[b].shape.get(), s.dimension, s.cell_size,
                              s.seed, b, plan.scene.file.parent_path(), warnings));
  for (std::string& warning : check_seeds(plan, seeds)) warnings.push_back(std::move(warning));
  return make_simulation(plan, seeds);
}

int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

/// What a run has done so far, for progress, run.json and the last line.
struct Account {
  Clock::time_point start = Clock::now();
  double seeding_seconds = 0, output_seconds = 0;
  std::int64_t steps = 0;
  std::uint64_t written_bytes = 0;
  nlohmann::json frames = nlohmann::json::array();
};

nlohmann::json run_record(const Plan& plan, const Estimate& e, const Simulation& simulation,
                          const Account& account, int threads, std::string_view state) {
  nlohmann::json passes;
  double stepping = 0;
  for (int p = 0; p < PassTimes::count; ++p) {
    const double seconds = simulation.times().seconds[static_cast<std::size_t>(p)];
    passes[std::string(PassTimes::names[static_cast<std::size_t>(p)])] = seconds;
    stepping += seconds;
  }
  const double updates = static_cast<double>(simulation.particles()) * static_cast<double>(account.steps);
  return {{"versions", {{"firn", kVersion}, {"compiler", __VERSION__}}},
          {"scene", plan.scene.as_run},
          {"state", state},
          {"plan", plan_json(plan, e)},
          {"threads", threads},
          {"particles", simulation.particles()},
          {"steps", account.steps},
          {"sorts", simulation.sorts()},
          {"seconds",
           {{"total", seconds_since(account.start)},
            {"seeding", account.seeding_seconds},
            {"output", account.output_seconds},
            {"passes", passes}}},
          {"particle_updates_per_second", stepping > 0 ? updates / stepping : 0},
          {"bytes", simulation.bytes()},
          {"frames", account.frames}};
}

}  // namespace

int run_scene(const RunOptions& options) {
  Account account;
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
  const std::unique_ptr<Simulation> simulation = seeded_simulation(plan, warnings);
  account.seeding_seconds = seconds_since(seeding);
  for (const std::string& warning : warnings) std::cerr << "warning: " << warning << '\n';

  g_signal = 0;
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  folder.remove_earlier_run();
  Diagnostics diagnostics(folder.path() / "diagnostics.csv", {kCounters.begin(), kCounters.end()});
  Progress progress(std::cerr,
                    {isatty(STDERR_FILENO) != 0, terminal_columns(), 1, range.last, simulation->particles()});
  Progress::State shown;
  const auto account_to = [&] {
    shown.steps = account.steps;
    shown.written_bytes = account.written_bytes;
    shown.seconds = seconds_since(account.start);
  };

  const double rate = plan.scene.simulation.frame_rate;
  const FrameSink write_frame = [&](const FrameView& frame) {
    const Clock::time_point start = Clock::now();
    const auto file = folder.frame_file(frame.frame);
    const std::uint64_t bytes =
        write_point_cache(file, frame, {plan.cell_size(), rate, std::string("firn ") + kVersion});
    diagnostics.append(frame);
    account.written_bytes += bytes;
    account.frames.push_back({{"frame", frame.frame},
                              {"time", frame.time},
                              {"file", file.filename().string()},
                              {"bytes", bytes},
                              {"content_xxh3", fmt::format("{:016x}", content_hash(frame))}});
    account.output_seconds += seconds_since(start);
    shown.frame = frame.frame;
    account_to();
    progress.frame_done(shown);
  };
  const StepListener listener = [&](int frame, double time, double dt) {
    ++account.steps;
    shown.frame = frame;
    shown.dt = dt;
    shown.fraction = 1 - ((frame - 1) / rate - time) * rate;
    account_to();
    progress.step(shown);
  };
  const auto record = [&](std::string_view state) {
    progress.finish();
    write_json(folder.path() / "run.json", run_record(plan, e, *simulation, account, threads, state));
  };

  bool finished = false;
  try {
    finished = run_frames(*simulation, rate, range.first, range.last, {&write_frame, 1}, listener,
                          [] { return g_signal != 0; });
  } catch (const Error& error) {
    progress.finish();
    if (error.code() == ExitCode::numerics) record("stopped: numerics");
    throw;
  }
  record(finished ? "finished" : "stopped by a signal");
  const nlohmann::json summary = run_record(plan, e, *simulation, account, threads, "");
  std::cerr << fmt::format(
      "{} {} frames, {} particles, {} steps in {}: {:.2f} M particle updates/s; {} in {}\n",
      finished ? "finished:" : "stopped:", account.frames.size(),
      grouped(static_cast<double>(simulation->particles())), grouped(static_cast<double>(account.steps)),
      duration_text(seconds_since(account.start)), summary["particle_updates_per_second"].get<double>() / 1e6,
      bytes_text(static_cast<double>(account.written_bytes)), folder.path().string());
  return finished ? 0 : 128 + g_signal;
}

}  // namespace firn
