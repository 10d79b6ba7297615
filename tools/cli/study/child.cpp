#include "tools/cli/study/child.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <optional>
#include <ostream>

#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include "engine/scene/estimate.h"
#include "engine/scene/reader.h"
#include "engine/scene/seed_check.h"
#include "engine/simulation/run.h"
#include "tools/cli/study/points.h"
#include "tools/cli/study/runs.h"

namespace firn {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Of all threads.
double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Vec3 vec(const double (&v)[3]) {
  return {v[0], v[1], v[2]};
}

/// How far conserved quantities are from where they began, at most.
class Drift {
 public:
  void look(const FrameTotals& t) {
    if (!first_) first_ = t;
    const double energy = std::abs(total(t) - total(*first_));
    energy_ = std::max(energy_, energy);
    scale_ = std::max(scale_, t.kinetic + t.elastic);
    momentum_ = std::max(momentum_, (vec(t.momentum) - vec(first_->momentum)).norm());
    angular_ = std::max(angular_, (vec(t.angular) - vec(first_->angular)).norm());
    speed_ = std::max(speed_, t.max_speed);
  }

  /// Null for what the scene does not conserve. Momentum in parts of the mass at the largest speed, angular
  /// momentum in parts of that at the distance `reach`.
  Json json(const Plan& plan, double reach) const {
    const bool held = plan.effects.domain || !plan.effects.colliders.empty();
    const bool pushed = plan.forces.any();
    const auto part = [](double x, double of) { return of > 0 ? Json(x / of) : Json(nullptr); };
    const double momentum = first_->mass * speed_;
    Json out = {{"energy", nullptr}, {"momentum", nullptr}, {"angular", nullptr}};
    if (!held && !pushed) out["energy"] = part(energy_, scale_);
    if (!held && !pushed && !plan.effects.gravity) {
      out["momentum"] = part(momentum_, momentum);
      out["angular"] = part(angular_, momentum * reach);
    }
    return out;
  }

 private:
  static double total(const FrameTotals& t) { return t.kinetic + t.elastic + t.gravity + t.dissipated; }

  std::optional<FrameTotals> first_;
  double energy_ = 0, scale_ = 0, momentum_ = 0, angular_ = 0, speed_ = 0;
};

struct Repeat {
  double seconds = 0, cpu = 0;
  std::array<double, PassTimes::count> passes{};
};

struct Result {
  std::int64_t steps = 0;
  double peak_bytes = 0;
  Drift drift;
  std::vector<BodyPoints> bodies;
};

std::vector<BodyPoints> collect(const Simulation& simulation, std::span<const Seeds> seeds) {
  const MaterialPoints now = simulation.material_points();
  std::vector<BodyPoints> out;
  std::size_t p = 0;
  for (const Seeds& body : seeds) {
    BodyPoints& points = out.emplace_back(body.position.size());
    for (std::size_t k = 0; k < body.position.size(); ++k, ++p) {
      points.start[k] = body.position[k];
      points.displacement[k] = now.position[p] - body.position[k];
      points.velocity[k] = now.velocity[p];
      points.stress[k] = now.stress[p];
      points.mass[k] = now.mass[p];
    }
  }
  return out;
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// `result`: filled by the first repeat; the others only take time.
Repeat run_once(const Plan& plan, std::span<const Seeds> seeds, Result* result) {
  const std::unique_ptr<Simulation> simulation = make_simulation(plan, seeds);
  const FrameSink sink = [&](const FrameView& frame) { result->drift.look(frame.totals); };
  std::int64_t steps = 0;
  const StepListener listener = [&](int, double, double) { ++steps; };
  const auto start = Clock::now();
  const double cpu = cpu_seconds();
  const std::span<const FrameSink> sinks{&sink, result != nullptr ? std::size_t{1} : 0};
  run_frames(*simulation, plan.scene.simulation.frame_rate, result != nullptr ? 1 : plan.frames() + 1,
             plan.frames(), sinks, listener, [] { return false; });
  Repeat out{seconds_since(start), cpu_seconds() - cpu, simulation->times().seconds};
  if (result != nullptr) {
    result->steps = steps;
    result->peak_bytes = peak_bytes();
    result->bodies = collect(*simulation, seeds);
  }
  return out;
}

/// Linear between the sorted values.
double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

Json seconds_json(const std::vector<Repeat>& repeats) {
  std::vector<double> seconds;
  double cpu = repeats.front().cpu;
  for (const Repeat& r : repeats) {
    seconds.push_back(r.seconds);
    cpu = std::min(cpu, r.cpu);
  }
  std::sort(seconds.begin(), seconds.end());
  return {{"median", quantile(seconds, 0.5)},
          {"min", seconds.front()},
          {"q1", quantile(seconds, 0.25)},
          {"q3", quantile(seconds, 0.75)},
          {"cpu", cpu}};
}

Json passes_json(const std::vector<Repeat>& repeats) {
  const Repeat& best = *std::min_element(repeats.begin(), repeats.end(),
                                         [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  Json out;
  for (std::size_t p = 0; p < best.passes.size(); ++p) out[std::string(PassTimes::names[p])] = best.passes[p];
  return out;
}

double reach(std::span<const Seeds> seeds) {
  double out = 0;
  for (const Seeds& body : seeds)
    for (const Vec3& x : body.position) out = std::max(out, x.norm());
  return out;
}

}  // namespace

int run_study_child(const StudyChildOptions& options, std::ostream& out) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(options.threads));
  const Plan plan = make_plan(read_scene(options.scene, options.overrides));
  std::vector<std::string> warnings;
  const std::vector<Seeds> seeds = seed_bodies(plan, warnings);
  Result result;
  // The run that is looked at only warms the machine up, unless it is the only one.
  const Repeat first = run_once(plan, seeds, &result);
  std::vector<Repeat> repeats;
  if (options.repeats == 1) repeats.push_back(first);
  while (repeats.size() < static_cast<std::size_t>(options.repeats))
    repeats.push_back(run_once(plan, seeds, nullptr));

  std::size_t particles = 0;
  for (const Seeds& body : seeds) particles += body.position.size();
  const double time = (plan.frames() - 1) / plan.scene.simulation.frame_rate;
  const Json line = {
      {"time", time},
      {"particles", particles},
      {"steps", result.steps},
      {"dt", time / static_cast<double>(result.steps)},
      {"seconds", seconds_json(repeats)},
      {"passes", passes_json(repeats)},
      {"work", static_cast<double>(particles) * static_cast<double>(result.steps) * nodes_per_particle(plan)},
      {"peak_bytes", result.peak_bytes},
      {"cache_bytes", estimate(plan).disk_bytes},
      {"drift", result.drift.json(plan, reach(seeds))}};
  write_points(options.points, result.bodies);
  out << line.dump() << '\n';
  return 0;
}

std::vector<std::string> study_child_arguments(const StudyChildOptions& options) {
  std::vector<std::string> out{
      "study-run", options.scene.string(),          "--threads", std::to_string(options.threads),
      "--repeats", std::to_string(options.repeats), "--points",  options.points.string()};
  for (const std::string& word : options.overrides) out.insert(out.end(), {"--set", word});
  return out;
}

}  // namespace firn
