#include "tools/cli/study/runs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/scene/estimate.h"
#include "engine/scene/fields.h"
#include "engine/scene/reader.h"
#include "engine/scene/with_kernel.h"
#include "tools/cli/study/scene_files.h"

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kThreads = "threads", kPerCell = "particles_per_cell";
constexpr double kMostRuns = 100000;

/// FNV-1a: no key of a study is chosen to hurt it.
std::uint64_t hash(std::string_view text, std::uint64_t seed = 0xcbf29ce484222325U) {
  for (const char c : text) seed = (seed ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return seed;
}

/// One value of each axis of a sweep, by index.
using Combination = std::vector<std::size_t>;

std::vector<Combination> combinations(const Sweep& sweep, std::uint64_t seed) {
  double count = 1;
  for (const Axis& axis : sweep.axes) count *= static_cast<double>(axis.values.size());
  if (count > kMostRuns)
    throw Error(ExitCode::input,
                fmt::format("a sweep has {:.3g} combinations; allowed: {:.0f} at most", count, kMostRuns));
  std::vector<Combination> out;
  Combination now(sweep.axes.size(), 0);
  for (;;) {
    out.push_back(now);
    std::size_t axis = now.size();
    while (axis > 0 && ++now[axis - 1] == sweep.axes[axis - 1].values.size()) now[--axis] = 0;
    if (axis == 0) break;
  }
  const auto wanted = static_cast<std::size_t>(sweep.sample);
  if (wanted == 0 || wanted >= out.size()) return out;
  // The first `wanted` of a shuffle that is the same on every machine.
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < wanted; ++i) std::swap(out[i], out[i + random() % (out.size() - i)]);
  out.resize(wanted);
  return out;
}

/// The scene's keys that a setting stands for.
std::vector<std::string> keys_of(const std::string& axis, const SceneDescription& scene) {
  if (axis == kThreads) return {};
  if (axis == kPerCell) {
    std::vector<std::string> out;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      if (scene.bodies[b].shape) out.push_back(fmt::format("bodies.{}.{}", b, kPerCell));
    return out;
  }
  return {axis.find('.') == std::string::npos ? "simulation." + axis : axis};
}

/// 2 instead of 2.0, as a study would write it.
Json number_json(double x) {
  return x == std::floor(x) && std::abs(x) < 1e15 ? Json(static_cast<std::int64_t>(x)) : Json(x);
}

/// The settings that every study shows.
Json common_settings(const Plan& plan, int threads) {
  const SimulationDescription& s = plan.scene.simulation;
  return {{"cell_size", number_json(s.cell_size)},
          {"kernel", word_of(kKernels, s.kernel)},
          {"transfer", word_of(kTransfers, s.transfer)},
          {"stress_order", word_of(kStressOrders, s.stress_order)},
          {"cfl", number_json(s.cfl)},
          {kPerCell, number_json(plan.scene.bodies.front().particles_per_cell)},
          {"precision", word_of(kPrecisions, s.precision)},
          {kThreads, threads}};
}

Json json_of(const std::string& toml) {
  const Json value = Json::parse(toml, nullptr, false);
  if (value.is_number_float()) return number_json(value.get<double>());
  return value.is_discarded() ? Json(toml) : value;
}

std::uint64_t key_of(const SceneDescription& scene, const StudyRun& run) {
  const std::uint64_t text =
      hash(fmt::format("{} threads {} repeats {}", scene.as_run, run.threads, run.repeats));
  return hash(scene_files_stamp(scene), text);
}

/// Fills in what the scene says of a run.
void resolve(const StudyDescription& study, StudyRun& run) {
  const Plan plan = plan_run(study, run);
  Json settings = common_settings(plan, run.threads);
  settings.update(run.settings);
  run.settings = std::move(settings);
  run.projected = estimate(plan).core_seconds / run.threads;
  run.key = key_of(plan.scene, run);
}

StudyRun combine(const StudyDescription& study, const SceneDescription& scene, const Sweep& sweep,
                 const Combination& chosen) {
  StudyRun run;
  run.overrides = study.set;
  run.threads = study.threads;
  run.repeats = study.repeats;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    const Axis& axis = sweep.axes[a];
    const std::string& value = axis.values[chosen[a]];
    run.settings[axis.name] = json_of(value);
    // A scene's ratio is one of FLIP, and no other transfer may have one.
    if (axis.name == "transfer" && run.settings[axis.name] != "flip")
      run.overrides.push_back("simulation.flip_ratio=");
    if (axis.name == kThreads) run.threads = run.settings[axis.name].get<int>();
    for (const std::string& key : keys_of(axis.name, scene))
      run.overrides.push_back(fmt::format("{}={}", key, value));
  }
  return run;
}

/// Between single quotes only a single quote means anything.
std::string quoted_for_shell(std::string_view word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

void check_threads(const StudyDescription& study) {
  Problems problems;
  for (const Sweep& sweep : study.sweeps)
    for (const Axis& axis : sweep.axes) {
      if (axis.name != kThreads) continue;
      for (const std::string& value : axis.values) {
        const Json number = json_of(value);
        if (number.is_number_integer() && number >= 1 && number <= 1024) continue;
        problems.add(axis.mark, axis.name,
                     fmt::format("found {}; allowed: integers, 1 to 1024", printable(value)));
      }
    }
  problems.throw_if_any();
}

/// For each value of each axis: whether a run can have it, else why the first could not.
struct Verdicts {
  struct Verdict {
    bool allowed = false;
    std::string reason;
  };
  std::map<std::pair<const Axis*, std::size_t>, Verdict> of;

  void add(const Sweep& sweep, const Combination& chosen, const std::string& refused) {
    for (std::size_t a = 0; a < chosen.size(); ++a) {
      Verdict& verdict = of[{&sweep.axes[a], chosen[a]}];
      verdict.allowed = verdict.allowed || refused.empty();
      if (verdict.reason.empty()) verdict.reason = refused;
    }
  }
  /// A value that no run can have is a mistake, not a combination to leave out.
  void check() const {
    Problems problems;
    for (const auto& [value, verdict] : of)
      if (!verdict.allowed)
        problems.add(value.first->mark, value.first->name,
                     fmt::format("no run can have {} = {}: {}", value.first->name,
                                 printable(value.first->values[value.second]), verdict.reason));
    problems.throw_if_any();
  }
};

}  // namespace

Plan plan_run(const StudyDescription& study, const StudyRun& run) {
  return make_plan(read_scene(study.scene, run.overrides));
}

std::vector<StudyRun> list_study_runs(const StudyDescription& study) {
  check_threads(study);
  // Mistakes of the scene itself come out here, before they would be those of every run.
  const Plan base = make_plan(read_scene(study.scene, study.set));
  if (base.frames() == 1)
    throw Error(ExitCode::input,
                fmt::format("{}: no step to measure; {}", study.scene.string(), base.warnings.back()));
  std::vector<StudyRun> out;
  std::set<std::string> seen;
  Verdicts verdicts;
  for (const Sweep& sweep : study.sweeps)
    for (const Combination& chosen : combinations(sweep, study.seed)) {
      StudyRun run = combine(study, base.scene, sweep, chosen);
      try {
        resolve(study, run);
      } catch (const Error& error) {
        run.refused = error.what();
      }
      verdicts.add(sweep, chosen, run.refused);
      if (seen.insert(run.settings.dump()).second) out.push_back(std::move(run));
    }
  verdicts.check();
  return out;
}

std::vector<StudyRun> list_reference_runs(const StudyDescription& study, const FinestRuns& truth) {
  std::vector<StudyRun> out;
  for (const double h : truth.cell_sizes) {
    StudyRun& run = out.emplace_back();
    run.overrides = study.set;
    run.overrides.insert(run.overrides.end(), truth.set.begin(), truth.set.end());
    run.overrides.push_back(fmt::format("simulation.cell_size={}", h));
    run.threads = study.threads;
    resolve(study, run);
  }
  return out;
}

std::vector<std::string> axis_names(const StudyDescription& study) {
  std::vector<std::string> out;
  for (const Sweep& sweep : study.sweeps)
    for (const Axis& axis : sweep.axes)
      if (std::find(out.begin(), out.end(), axis.name) == out.end()) out.push_back(axis.name);
  return out;
}

std::string arguments_text(const StudyRun& run) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._=+-,/";
  std::string out;
  for (std::string word : run.overrides) {
    // TOML's strings come with quotes, which a bare word does without.
    const std::size_t value = word.find('=') + 1;
    if (word.size() > value + 1 && word[value] == '"' && word.back() == '"' &&
        word.find_first_not_of(kPlain, value + 1) == word.size() - 1)
      word = word.substr(0, value) + word.substr(value + 1, word.size() - value - 2);
    out += fmt::format("{}--set {}", out.empty() ? "" : " ",
                       word.find_first_not_of(kPlain) == std::string::npos ? word : quoted_for_shell(word));
  }
  return out + fmt::format("{}--threads {}", out.empty() ? "" : " ", run.threads);
}

double nodes_per_particle(const Plan& plan) {
  const double nodes = with_kernel(plan.scene.simulation.kernel, [](auto kernel) { return kernel.nodes; });
  return std::pow(nodes, plan.dimension());
}

}  // namespace firn
