#include "tools/cli/bench_list.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/base/parallel.h"
#include "engine/scene/reader.h"
#include "tools/cli/bench_cases.h"

namespace firn {
namespace {

/// A scene and the instruction set it is to run with; empty: what its plan chose.
struct Request {
  std::shared_ptr<const BenchSubject> subject;
  std::optional<Isa> isa;
};

Isa parse_isa(const std::string& text) {
  std::vector<std::string_view> names;
  for (const Isa isa : kIsas) names.push_back(name(isa));
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end())
    throw Error(ExitCode::input, "--isa: " + unknown_name("instruction set", text, names));
  const Isa isa = kIsas[static_cast<std::size_t>(found - names.begin())];
  if (!available(isa))
    throw Error(ExitCode::environment, fmt::format("--isa {}: this processor does not have it", text));
  return isa;
}

SceneDescription read_subject(const std::string& name, const std::vector<std::string>& overrides) {
  if (const BenchCase* built_in = find_bench_case(name))
    return read_scene_text(bench_scene(*built_in), name + ".toml", overrides);
  std::error_code ignored;
  if (std::filesystem::exists(name, ignored)) return read_scene(name, overrides);
  std::vector<std::string_view> names;
  for (const BenchCase& c : kBenchCases) names.push_back(c.name);
  throw Error(ExitCode::input,
              fmt::format("{}; and there is no such scene file", unknown_name("case", name, names)));
}

std::shared_ptr<const BenchSubject> make_subject(const std::string& name,
                                                 std::vector<std::string> overrides) {
  Plan plan = make_plan(read_subject(name, overrides));
  if (plan.frames() == 1)
    throw Error(ExitCode::input, fmt::format("{}: no step to measure; {}", name, plan.warnings.back()));
  return std::make_shared<const BenchSubject>(BenchSubject{name, std::move(overrides), std::move(plan)});
}

void add_defaults(const BenchOptions& options, std::vector<Request>& requests) {
  const std::optional<Isa> best = best_isa();
  for (const BenchDefault& d : kBenchDefaults) {
    // What the processor runs anyway, or cannot run, needs no measurement of its own.
    if (d.isa && (!best || *d.isa >= *best)) continue;
    std::vector<std::string> overrides{fmt::format("simulation.precision={}", d.precision)};
    overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
    requests.push_back({make_subject(std::string(d.name), std::move(overrides)), d.isa});
  }
}

/// Each request with each of the instruction sets the user named.
std::vector<Request> with_isas(const std::vector<Request>& requests, const std::vector<std::string>& isas) {
  if (isas.empty()) return requests;
  std::vector<Request> out;
  for (const Request& r : requests)
    for (const std::string& isa : isas) out.push_back({r.subject, parse_isa(isa)});
  return out;
}

std::optional<Isa> resolve(const Request& request) {
  const PathPlan& path = request.subject->plan.path;
  if (!request.isa) return path.isa;
  if (!path.isa)
    throw Error(ExitCode::input,
                fmt::format("--isa {}: {} takes the plain path, which has no instruction set: {}",
                            name(*request.isa), request.subject->name, path.reason));
  return request.isa;
}

std::vector<int> thread_counts(const std::vector<int>& asked) {
  const int cores = default_threads();
  if (asked.empty()) return cores > 1 ? std::vector{1, cores} : std::vector{1};
  const int most = *std::max_element(asked.begin(), asked.end());
  if (most > cores)
    throw Error(ExitCode::input,
                fmt::format("--threads {}: this process may run on {} core{} only; more threads would not "
                            "run side by side",
                            most, cores, cores == 1 ? "" : "s"));
  return asked;
}

bool same(const BenchRun& a, const BenchRun& b) {
  return a.subject->name == b.subject->name && a.precision() == b.precision() && a.threads == b.threads &&
         a.isa == b.isa;
}

}  // namespace

std::string BenchRun::title() const {
  return fmt::format("{} {} {}, {} thread{}", subject->name, name(precision()), isa_name(), threads,
                     threads == 1 ? "" : "s");
}

std::vector<BenchRun> list_runs(const BenchOptions& options) {
  const std::vector<int> threads = thread_counts(options.threads);
  std::vector<Request> requests;
  for (const std::string& name : options.scenes)
    requests.push_back({make_subject(name, options.overrides), std::nullopt});
  if (options.scenes.empty()) add_defaults(options, requests);
  std::vector<BenchRun> runs;
  for (const Request& request : with_isas(requests, options.isas))
    for (const int n : threads) {
      const BenchRun run{request.subject, n, resolve(request)};
      // Options may make two requests the same, as --set simulation.precision=double does with the defaults.
      if (std::none_of(runs.begin(), runs.end(), [&](const BenchRun& r) { return same(r, run); }))
        runs.push_back(run);
    }
  return runs;
}

}  // namespace firn
