#include "tools/cli/bench.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/base/parallel.h"
#include "engine/scene/reader.h"
#include "engine/scene/seed_check.h"
#include "engine/simulation/run.h"
#include "tools/cli/bench_cases.h"

namespace firn {
namespace {

struct Case {
  std::string name;
  Plan plan;
  std::vector<Seeds> seeds;
  int steps;  // of a round; 0: to the scene's end
};

/// What a round took.
struct Round {
  std::int64_t steps = 0;
  double seconds = 0;
  std::array<double, PassTimes::count> passes{};

  double per_step() const { return seconds / static_cast<double>(steps); }
};

struct Measurement {
  const Case* of;
  int threads;
  std::optional<Isa> isa;
  std::size_t particles = 0, bytes = 0;
  std::vector<Round> rounds;

  const Round& best() const {
    return *std::min_element(rounds.begin(), rounds.end(),
                             [](const Round& a, const Round& b) { return a.per_step() < b.per_step(); });
  }
  double median_per_step() const {
    std::vector<double> all;
    for (const Round& r : rounds) all.push_back(r.per_step());
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return all[all.size() / 2];
  }
};

Case make_case(const std::string& name, const BenchOptions& options) {
  const auto built_in = std::find_if(std::begin(kBenchCases), std::end(kBenchCases),
                                     [&](const BenchCase& c) { return c.name == name; });
  const bool found = built_in != std::end(kBenchCases);
  Case out{name,
           make_plan(found ? read_scene_text(bench_scene(*built_in), name + ".toml", options.overrides)
                           : read_scene(name, options.overrides)),
           {},
           options.steps > 0 ? options.steps
           : found           ? kBenchSteps
                             : 0};
  std::vector<std::string> warnings;
  out.seeds = seed_bodies(out.plan, warnings);
  return out;
}

std::optional<Isa> find_isa(const std::string& text) {
  static constexpr Isa kAll[] = {Isa::sse4, Isa::avx2, Isa::avx512};
  std::vector<std::string_view> names;
  for (const Isa isa : kAll) {
    if (name(isa) == text) return isa;
    names.push_back(name(isa));
  }
  throw Error(ExitCode::input, "--isa: " + unknown_name("instruction set", text, names));
}

void measure(Measurement& m) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(m.threads));
  Plan plan = m.of->plan;
  if (m.isa) plan.path.isa = m.isa;
  const std::unique_ptr<Simulation> simulation = make_simulation(plan, m.of->seeds);
  m.particles = simulation->particles();
  Round round;
  const StepListener listener = [&](int, double, double) { ++round.steps; };
  const StopRequested stop = [&] { return m.of->steps > 0 && round.steps == m.of->steps; };
  const auto start = std::chrono::steady_clock::now();
  // No frame is looked at.
  run_frames(*simulation, plan.scene.simulation.frame_rate, plan.frames() + 1, plan.frames(), {}, listener,
             stop);
  round.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  round.passes = simulation->times().seconds;
  m.bytes = simulation->bytes();
  m.rounds.push_back(round);
}

std::string_view precision(const Plan& plan) {
  return plan.scene.simulation.precision == Precision::single ? "float" : "double";
}

nlohmann::ordered_json to_json(const Measurement& m) {
  const Round& best = m.best();
  const double per_update = 1e9 / (static_cast<double>(best.steps) * static_cast<double>(m.particles));
  nlohmann::ordered_json passes;
  for (std::size_t p = 0; p < best.passes.size(); ++p)
    if (best.passes[p] > 0) passes[std::string(PassTimes::names[p])] = best.passes[p] * per_update;
  const std::optional<Isa> isa = m.isa ? m.isa : m.of->plan.path.isa;
  return {{"case", m.of->name},
          {"precision", precision(m.of->plan)},
          {"threads", m.threads},
          {"isa", isa ? name(*isa) : "plain"},
          {"particles", m.particles},
          {"steps", best.steps},
          {"ns_per_particle_step", best.seconds * per_update},
          {"median_ns", m.median_per_step() * 1e9 / static_cast<double>(m.particles)},
          {"million_per_second", 1e3 / (best.seconds * per_update)},
          {"bytes_per_particle", static_cast<double>(m.bytes) / static_cast<double>(m.particles)},
          {"passes", passes}};
}

}  // namespace

int run_bench(const BenchOptions& options, std::ostream& out) {
  std::vector<std::string> names = options.scenes;
  if (names.empty())
    for (const BenchCase& c : kBenchCases) names.emplace_back(c.name);
  std::vector<int> threads = options.threads;
  if (threads.empty()) threads = {1};
  if (options.threads.empty() && default_threads() > 1) threads.push_back(default_threads());
  std::vector<std::optional<Isa>> isas;
  for (const std::string& isa : options.isas) isas.push_back(find_isa(isa));
  if (isas.empty()) isas.push_back(std::nullopt);

  std::vector<Case> cases;
  for (const std::string& name : names) cases.push_back(make_case(name, options));
  std::vector<Measurement> measurements;
  for (const Case& c : cases)
    for (const std::optional<Isa>& isa : isas)
      for (const int n : threads) measurements.push_back({&c, n, isa, 0, 0, {}});
  for (int r = 0; r < options.rounds; ++r)
    for (Measurement& m : measurements) measure(m);
  for (const Measurement& m : measurements) out << to_json(m).dump() << '\n';
  return 0;
}

}  // namespace firn
