#include "tools/cli/bench.h"

#include <algorithm>
#include <chrono>
#include <map>

#include <tbb/global_control.h>

#include "engine/scene/seed_check.h"
#include "engine/simulation/run.h"
#include "tools/cli/bench_cases.h"
#include "tools/cli/bench_ceilings.h"
#include "tools/cli/bench_progress.h"
#include "tools/cli/bench_samples.h"
#include "tools/cli/bench_table.h"
#include "tools/cli/bench_vs.h"
#include "tools/cli/work_count.h"

namespace firn {
namespace {

/// What a round took.
struct Round {
  std::int64_t steps = 0;
  double seconds = 0;
  std::array<double, PassTimes::count> passes{};
};

struct Measurement {
  BenchRun run;
  std::size_t particles = 0, bytes = 0;
  Work work;                    // of the vectorised path
  std::vector<double> samples;  // ns per particle and step, by round
  Round best;

  double per_update(double seconds, std::int64_t steps) const {
    return 1e9 * seconds / (static_cast<double>(steps) * static_cast<double>(particles));
  }
};

using AllSeeds = std::map<const BenchSubject*, std::vector<Seeds>>;

AllSeeds seed_subjects(const std::vector<BenchRun>& runs) {
  AllSeeds out;
  std::vector<std::string> warnings;  // not of the scene's speed
  for (const BenchRun& run : runs)
    if (!out.contains(run.subject.get())) out[run.subject.get()] = seed_bodies(run.subject->plan, warnings);
  return out;
}

int steps_of(const BenchRun& run, const BenchOptions& options) {
  if (options.steps > 0) return options.steps;
  return find_bench_case(run.subject->name) != nullptr ? kBenchSteps : 0;
}

Work work_of(const Plan& plan, std::span<const Seeds> seeds, std::size_t occupied_blocks) {
  std::vector<std::size_t> particles(plan.batches.size());
  for (std::size_t b = 0; b < seeds.size(); ++b) particles[plan.bodies[b].batch] += seeds[b].position.size();
  return count_work(plan, particles, occupied_blocks);
}

/// One more round. `steps`: 0 to the scene's end.
void measure(Measurement& m, std::span<const Seeds> seeds, int steps) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(m.run.threads));
  Plan plan = m.run.subject->plan;
  plan.path.isa = m.run.isa;
  const std::unique_ptr<Simulation> simulation = make_simulation(plan, seeds);
  Round round;
  const StepListener listener = [&](int, double, double) { ++round.steps; };
  const StopRequested stop = [&] { return steps > 0 && round.steps == steps; };
  const auto start = std::chrono::steady_clock::now();
  // No frame is looked at.
  run_frames(*simulation, plan.scene.simulation.frame_rate, plan.frames() + 1, plan.frames(), {}, listener,
             stop);
  round.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  round.passes = simulation->times().seconds;

  m.particles = simulation->particles();
  m.bytes = simulation->bytes();
  if (m.run.isa) m.work = work_of(plan, seeds, simulation->occupied_blocks());
  m.samples.push_back(m.per_update(round.seconds, round.steps));
  if (m.samples.back() == best(m.samples)) m.best = round;
}

nlohmann::ordered_json row(const Measurement& m, const Ceilings& ceilings) {
  const double ns = best(m.samples);
  nlohmann::ordered_json flops, bytes, fma_fraction, bandwidth_fraction, passes;
  if (m.run.isa) {
    flops = m.work.flops;
    bytes = m.work.bytes;
    // Operations or bytes in a nanosecond are 1e9 of them in a second.
    fma_fraction = m.work.flops / ns / ceilings.gflops(m.run);
    bandwidth_fraction = m.work.bytes / ns / ceilings.gb_per_s(m.run);
  }
  for (std::size_t p = 0; p < m.best.passes.size(); ++p) {
    auto& pass = passes[std::string(PassTimes::names[p])];
    if (m.best.passes[p] > 0) pass = m.per_update(m.best.passes[p], m.best.steps);
  }
  return {{"case", m.run.subject->name},
          {"precision", name(m.run.precision())},
          {"threads", m.run.threads},
          {"isa", m.run.isa_name()},
          {"particles", m.particles},
          {"steps", m.best.steps},
          {"ns_per_particle_step", ns},
          {"median_ns", median(m.samples)},
          {"million_per_second", 1e3 / ns},
          {"bytes_per_particle", static_cast<double>(m.bytes) / static_cast<double>(m.particles)},
          {"flops_per_particle_step", flops},
          {"bytes_per_particle_step", bytes},
          {"fma_fraction", fma_fraction},
          {"bandwidth_fraction", bandwidth_fraction},
          {"passes", passes}};
}

void print(const std::vector<Measurement>& measurements, const Ceilings& ceilings, bool json,
           std::ostream& out) {
  BenchRows rows;
  for (const Measurement& m : measurements) rows.push_back(row(m, ceilings));
  if (json) {
    print_json(rows, out);
    print_json(ceilings.rows(), out);
    return;
  }
  print_csv(rows, out);
  if (ceilings.rows().empty()) return;
  out << '\n';
  print_csv(ceilings.rows(), out);
}

}  // namespace

int run_bench(const BenchOptions& options, std::ostream& out) {
  const std::vector<BenchRun> runs = list_runs(options);
  if (options.vs) return compare_builds(options, runs, out);
  BenchProgress progress(options.rounds);
  progress.show("seeding");
  const AllSeeds seeds = seed_subjects(runs);
  std::vector<Measurement> measurements;
  for (const BenchRun& run : runs) measurements.push_back({run, 0, 0, {}, {}, {}});
  Ceilings ceilings;
  // In turns: a machine that slows down slows down everything.
  for (int r = 1; r <= options.rounds; ++r)
    for (Measurement& m : measurements) {
      progress.show(r, m.run.title());
      ceilings.measure(m.run);
      measure(m, seeds.at(m.run.subject.get()), steps_of(m.run, options));
    }
  progress.finish();
  print(measurements, ceilings, options.json, out);
  return 0;
}

}  // namespace firn
