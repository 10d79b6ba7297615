#include "tools/cli/study/study.h"

#include <chrono>
#include <iostream>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/output/output_folder.h"
#include "tools/cli/child_program.h"
#include "tools/cli/study/child.h"
#include "tools/cli/study/errors.h"
#include "tools/cli/study/parse.h"
#include "tools/cli/study/reader.h"
#include "tools/cli/study/report.h"
#include "tools/cli/study/run_store.h"
#include "tools/cli/units.h"

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

ProgramAnswer run_child(const StudyDescription& study, const StudyRun& run,
                        const std::filesystem::path& points) {
  // The link stays with the file that runs here, also when it is rebuilt meanwhile.
  return run_program("/proc/self/exe",
                     study_child_arguments({study.scene, run.overrides, run.threads, run.repeats, points}));
}

std::string first_line(const std::string& text) {
  return printable(text.substr(0, text.find('\n')), 500);
}

/// What every record has, whatever became of the run.
Json blank_record(const StudyRun& run) {
  return {{"id", ""},
          {"settings", run.settings},
          {"arguments", arguments_text(run)},
          {"state", "refused"},
          {"reason", ""},
          {"particles", nullptr},
          {"steps", nullptr},
          {"dt", nullptr},
          {"seconds", nullptr},
          {"passes", nullptr},
          {"work", nullptr},
          {"peak_bytes", nullptr},
          {"cache_bytes", nullptr},
          {"error", nullptr},
          {"drift", nullptr}};
}

Json errors_json(const std::vector<BodyPoints>& points, const Truth& truth) {
  const auto norms = errors(points, truth.at(points));
  const auto json = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  Json out;
  for (std::size_t q = 0; q < kQuantities; ++q)
    if (truth.knows(static_cast<StudyQuantity>(q)))
      out[std::string(kQuantityNames[q])] = {{"l2", json(norms[q].l2)}, {"max", json(norms[q].max)}};
  return out;
}

Json make_record(const StudyDescription& study, const StudyRun& run, const Truth& truth,
                 const RunStore& store) {
  const std::filesystem::path file = store.file(run, "points");
  const auto start = std::chrono::steady_clock::now();
  const ProgramAnswer answer = run_child(study, run, file);
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Json record = blank_record(run);
  if (answer.status == 0) {
    record.update(Json::parse(answer.out));
    record["state"] = "finished";
    record["error"] = errors_json(read_points(file), truth);
  } else if (answer.status == static_cast<int>(ExitCode::io)) {
    throw Error(ExitCode::io, first_line(answer.error));  // a full disk is no property of these settings
  } else {
    record["state"] = "failed";
    record["reason"] =
        answer.error.empty() ? fmt::format("ended with code {}", answer.status) : first_line(answer.error);
    record["seconds"] = {{"median", took}};
  }
  record["seconds"]["projected"] = run.projected;
  record.erase("time");
  std::filesystem::remove(file);
  return record;
}

/// The particles of a reference run, made if need be.
std::vector<BodyPoints> reference_points(const StudyDescription& study, const StudyRun& run,
                                         const RunStore& store) {
  const std::filesystem::path file = store.file(run, "reference");
  if (!store.find(run).is_null() && std::filesystem::exists(file)) return read_points(file);
  const ProgramAnswer answer = run_child(study, run, file);
  if (answer.status != 0)
    throw Error(static_cast<ExitCode>(answer.status),
                fmt::format("the run with cells of {} m, which was to be the truth, failed: {}",
                            run.settings["cell_size"].dump(), first_line(answer.error)));
  store.keep(run, blank_record(run));
  return read_points(file);
}

std::string hex(std::uint64_t key) {
  return fmt::format("{:016x}", key);
}

/// The truth, and by what it is told from another one.
struct NamedTruth {
  std::unique_ptr<Truth> truth;
  std::string name;
};

NamedTruth make_truth(const StudyDescription& study, const Plan& plan, double time,
                      const std::filesystem::path& folder) {
  if (const auto* form = std::get_if<ClosedForm>(&study.truth)) {
    auto truth = closed_form_truth(*form, plan, time);
    const std::string name = truth->text();
    return {std::move(truth), name};
  }
  const auto& form = std::get<FinestRuns>(study.truth);
  const RunStore store(folder, "itself");
  std::vector<std::vector<BodyPoints>> levels;
  std::string name;
  for (const StudyRun& run : list_reference_runs(study, form)) {
    std::cerr << fmt::format("truth: cells of {} m, about {}\n", run.settings["cell_size"].dump(),
                             duration_text(run.projected));
    levels.push_back(reference_points(study, run, store));
    name += hex(run.key);
  }
  return {finest_truth(form, std::move(levels), plan.dimension()), name};
}

void print_projection(const StudyDescription& study, const std::vector<StudyRun>& runs, std::ostream& out) {
  double all = 0;
  for (const StudyRun& run : runs) {
    Json shown{{"axes", axis_names(study)}, {"settings", run.settings}};
    const bool refused = !run.refused.empty();
    const double seconds = refused ? 0 : run.projected * (run.repeats > 1 ? run.repeats + 1 : 1);
    out << fmt::format("{:>9}  {}\n", refused ? "refused" : duration_text(seconds),
                       settings_text(shown, shown));
    all += seconds;
  }
  out << fmt::format("{} runs, about {} in all\n", runs.size(), duration_text(all));
}

StudyRecords make_records(const StudyDescription& study, const std::vector<StudyRun>& runs,
                          const Truth& truth, const RunStore& store) {
  StudyRecords out;
  for (const StudyRun& run : runs) {
    Json record = run.refused.empty() ? store.find(run) : blank_record(run);
    if (!run.refused.empty()) record["reason"] = run.refused;
    if (record.is_null()) {
      record = make_record(study, run, truth, store);
      store.keep(run, record);
      const auto error = error_of(record, kQuantityNames[0]);
      std::cerr << fmt::format("{}/{}: {}, {}\n", out.size() + 1, runs.size(),
                               settings_text({{"axes", axis_names(study)}}, record),
                               error ? fmt::format("{:.3g} % in {:.3g} s", 100 * *error, seconds_of(record))
                                     : record["reason"].get<std::string>());
    }
    record["id"] = fmt::format("{:04}", out.size() + 1);
    out.push_back(std::move(record));
  }
  return out;
}

void print_choice(const Json* run, const StudyOptions& options, std::ostream& out) {
  if (run == nullptr)
    throw Error(
        ExitCode::input,
        fmt::format("no run of this study has {} of {} or less; see the table without it",
                    options.error ? "an error" : "a time", options.error ? *options.error : *options.budget));
  std::cerr << fmt::format("{}: error {:.3g} %, {:.3g} s\n", options.quantity,
                           100 * *error_of(*run, options.quantity), seconds_of(*run));
  out << (*run)["arguments"].get<std::string>() << '\n';
}

}  // namespace

int run_study(const StudyOptions& options, std::ostream& out) {
  const StudyDescription study = read_study(options.study);
  // Neither is ever 0.
  const double error = options.error ? parse_error(*options.error) : 0;
  const double budget = options.budget ? parse_seconds(*options.budget) : 0;
  const std::vector<StudyRun> runs = list_study_runs(study);
  if (options.list) {
    print_projection(study, runs, out);
    return 0;
  }
  print_projection(study, runs, std::cerr);
  const auto path = options.out.empty() ? std::filesystem::path("out") / options.study.stem() : options.out;
  OutputFolder folder(path, {true, 0});
  StudyRun base;
  base.overrides = study.set;
  const Plan plan = plan_run(study, base);
  const double time = (plan.frames() - 1) / plan.scene.simulation.frame_rate;
  const NamedTruth named = make_truth(study, plan, time, path);
  const RunStore store(path, named.name);
  const StudyRecords records = make_records(study, runs, *named.truth, store);
  const Json json = study_json(study, *named.truth, time, records);
  write_text(path / "study.json", json_text(json));
  write_text(path / "study.csv", study_csv(json));
  write_text(path / "study.html", study_page(json));

  if (error > 0) {
    print_choice(cheapest(records, options.quantity, error), options, out);
  } else if (budget > 0) {
    print_choice(most_accurate(records, options.quantity, budget), options, out);
  } else {
    out << study_summary(json, options.quantity);
  }
  std::cerr << fmt::format("in {}: study.html, study.csv, study.json\n", path.string());
  return 0;
}

}  // namespace firn
