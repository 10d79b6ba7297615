#include "tools/cli/bench_vs.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "tools/cli/bench_progress.h"
#include "tools/cli/bench_samples.h"
#include "tools/cli/bench_table.h"
#include "tools/cli/child_program.h"

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

struct Comparison {
  BenchRun run;
  std::vector<std::string> arguments;
  std::size_t particles = 0;
  std::vector<double> ns, vs_ns;  // per particle and step, by round
};

/// `firn bench` for one round of this run alone. All is said, so that it does not matter what the other build
/// would choose by itself.
std::vector<std::string> arguments_of(const BenchRun& run, int steps) {
  std::vector<std::string> out{"bench",     run.subject->name,          "--json", "--rounds", "1",
                               "--threads", std::to_string(run.threads)};
  if (run.isa) out.insert(out.end(), {"--isa", std::string(name(*run.isa))});
  if (steps > 0) out.insert(out.end(), {"--steps", std::to_string(steps)});
  for (const std::string& value : run.subject->overrides) out.insert(out.end(), {"--set", value});
  return out;
}

/// The line of `text` that is this measurement; null when it is none of them.
Json find_line(const std::string& text, const BenchRun& run) {
  const Json wanted{{"case", run.subject->name},
                    {"precision", name(run.precision())},
                    {"threads", run.threads},
                    {"isa", run.isa_name()}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const Json found = Json::parse(line, nullptr, false);
    if (!found.is_object() || !found.contains("particles") || !found.contains("ns_per_particle_step"))
      continue;
    if (!found["particles"].is_number_unsigned() || !found["ns_per_particle_step"].is_number()) continue;
    const auto fits = [&](const auto& item) {
      return found.contains(item.key()) && found[item.key()] == item.value();
    };
    const auto items = wanted.items();
    if (std::all_of(items.begin(), items.end(), fits)) return found;
  }
  return nullptr;
}

/// The first line of what a program printed, as a part of a message.
std::string first_line(std::string_view text) {
  return printable(text.substr(0, text.find('\n')), 1000);
}

/// One of the two that are compared.
struct Build {
  std::string program, shown;  // its file, and its name in messages
  bool is_this;
};

Json measure(const Build& build, const Comparison& c) {
  const ProgramAnswer answer = run_program(build.program, c.arguments);
  if (answer.status != 0)
    // This build says itself what was wrong; that the other one fails is a mistake in what was asked.
    throw Error(build.is_this ? static_cast<ExitCode>(answer.status) : ExitCode::input,
                fmt::format("{}: ended with exit code {} on {}: {}", build.shown, answer.status,
                            c.run.title(), first_line(answer.error)));
  const Json line = find_line(answer.out, c.run);
  if (line.is_null())
    throw Error(ExitCode::input,
                fmt::format("{}: printed no measurement of {}, as firn bench --json does; found '{}'",
                            build.shown, c.run.title(), first_line(answer.out)));
  return line;
}

Json row(const Comparison& c) {
  return {{"case", c.run.subject->name},
          {"precision", name(c.run.precision())},
          {"threads", c.run.threads},
          {"isa", c.run.isa_name()},
          {"particles", c.particles},
          {"ns_per_particle_step", best(c.ns)},
          {"median_ns", median(c.ns)},
          {"vs_ns_per_particle_step", best(c.vs_ns)},
          {"vs_median_ns", median(c.vs_ns)},
          {"ratio", best(c.vs_ns) / best(c.ns)},
          {"median_ratio", median(c.vs_ns) / median(c.ns)}};
}

}  // namespace

int compare_builds(const BenchOptions& options, const std::vector<BenchRun>& runs, std::ostream& out) {
  std::vector<Comparison> comparisons;
  for (const BenchRun& run : runs) comparisons.push_back({run, arguments_of(run, options.steps), 0, {}, {}});
  // The link stays with the file that runs here, also when it is rebuilt meanwhile.
  const Build ours{"/proc/self/exe", "this build", true};
  const Build other{*options.vs, "--vs " + printable(*options.vs, 4096), false};
  BenchProgress progress(options.rounds);
  for (int r = 1; r <= options.rounds; ++r)
    for (Comparison& c : comparisons) {
      // The other one first: if it cannot be run, that shows at once.
      progress.show(r, c.run.title() + ", the other build");
      c.vs_ns.push_back(measure(other, c)["ns_per_particle_step"].get<double>());
      progress.show(r, c.run.title() + ", this build");
      const Json line = measure(ours, c);
      c.ns.push_back(line["ns_per_particle_step"].get<double>());
      c.particles = line["particles"].get<std::size_t>();
    }
  progress.finish();
  BenchRows rows;
  for (const Comparison& c : comparisons) rows.push_back(row(c));
  options.json ? print_json(rows, out) : print_csv(rows, out);
  return 0;
}

}  // namespace firn
