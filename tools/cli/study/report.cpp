#include "tools/cli/study/report.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "engine/simulation/simulation.h"
#include "tools/cli/study/page.h"
#include "tools/cli/version.h"

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

Json truth_json(const StudyDescription& study, const Truth& truth) {
  Json uncertainty, order;
  for (std::size_t q = 0; q < kQuantities; ++q) {
    const auto quantity = static_cast<StudyQuantity>(q);
    if (!truth.knows(quantity)) continue;
    uncertainty[std::string(kQuantityNames[q])] = truth.uncertainty(quantity);
    const auto p = truth.order(quantity);
    order[std::string(kQuantityNames[q])] = p ? Json(*p) : Json(nullptr);
  }
  const auto* finest = std::get_if<FinestRuns>(&study.truth);
  return {{"type", finest != nullptr ? "finest" : "closed_form"},
          {"text", truth.text()},
          {"order", order},
          {"levels", finest != nullptr ? Json(finest->cell_sizes) : Json::array()},
          {"uncertainty", uncertainty}};
}

/// The quantities whose error is not well above what the truth itself is off by.
Json greyed(const Json& run, const Json& uncertainty) {
  Json out = Json::array();
  for (const auto& item : uncertainty.items()) {
    const auto error = error_of(run, item.key());
    if (error && *error < 10 * item.value().get<double>()) out.push_back(item.key());
  }
  return out;
}

/// Those whose value is not the same in all runs.
Json varying_axes(const StudyDescription& study, const StudyRecords& runs) {
  Json out = Json::array();
  for (const std::string& axis : axis_names(study)) {
    const auto value = [&](const Json& run) { return run["settings"].value(axis, Json()); };
    if (std::any_of(runs.begin(), runs.end(), [&](const Json& run) { return value(run) != value(runs[0]); }))
      out.push_back(axis);
  }
  return out;
}

// Values hold no line breaks; words from a scene may hold commas and quotes.
std::string csv_field(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

/// Name and value of each column of a run.
std::vector<std::pair<std::string, Json>> columns(const Json& study, const Json& run) {
  std::vector<std::pair<std::string, Json>> out{{"id", run["id"]}};
  const auto all = [&](const std::string& prefix, const Json& names, const Json& values) {
    for (const auto& item : names.items())
      out.emplace_back(prefix + item.key(), values.is_object() ? values.value(item.key(), Json()) : Json());
  };
  const Json& model = study["runs"][0];
  all("", model["settings"], run["settings"]);
  for (const char* key : {"state", "particles", "steps", "dt"}) out.emplace_back(key, run[key]);
  all("seconds_", {{"median", 0}, {"min", 0}, {"q1", 0}, {"q3", 0}, {"cpu", 0}, {"projected", 0}},
      run["seconds"]);
  for (const std::string_view pass : PassTimes::names)
    out.emplace_back(fmt::format("seconds_{}", pass),
                     run["passes"].is_object() ? run["passes"].value(pass, Json()) : Json());
  for (const char* key : {"work", "peak_bytes", "cache_bytes"}) out.emplace_back(key, run[key]);
  for (const auto& quantity : study["quantities"]) {
    const Json error =
        run["error"].is_object() ? run["error"].value(quantity.get<std::string>(), Json()) : Json();
    for (const char* norm : {"l2", "max"})
      out.emplace_back(fmt::format("{}_{}", quantity.get<std::string>(), norm),
                       error.is_object() ? error.value(norm, Json()) : Json());
  }
  all("drift_", {{"energy", 0}, {"momentum", 0}, {"angular", 0}}, run["drift"]);
  std::string grey;
  for (const auto& quantity : run["greyed"]) grey += (grey.empty() ? "" : " ") + quantity.get<std::string>();
  out.emplace_back("greyed", grey);
  out.emplace_back("reason", run["reason"]);
  return out;
}

std::string percent(double error) {
  return fmt::format("{:.3g} %", 100 * error);
}

std::string seconds_text(double seconds) {
  return seconds < 1 ? fmt::format("{:.3g} ms", 1000 * seconds) : fmt::format("{:.3g} s", seconds);
}

}  // namespace

Json study_json(const StudyDescription& study, const Truth& truth, double time, const StudyRecords& runs) {
  Json quantities = Json::array(), front, reach;
  const Json facts = truth_json(study, truth);
  for (const auto& item : facts["uncertainty"].items()) {
    quantities.push_back(item.key());
    front[item.key()] = Json::array();
    for (const Json* run : pareto_front(runs, item.key())) front[item.key()].push_back((*run)["id"]);
    for (const double error : kReachedErrors) {
      const Json* run = cheapest(runs, item.key(), error);
      reach[item.key()].push_back({{"error", error}, {"run", run != nullptr ? (*run)["id"] : Json(nullptr)}});
    }
  }
  Json all = runs;
  for (Json& run : all) run["greyed"] = greyed(run, facts["uncertainty"]);
  return {{"format", "firn study 1"},
          {"title", study.title},
          {"description", study.description},
          {"study", study.file.filename().string()},
          {"scene", study.scene.lexically_normal().string()},
          {"made",
           {{"firn", kVersion},
            {"compiler", __VERSION__},
            {"machine", machine_name()},
            {"cores", std::thread::hardware_concurrency()},
            {"date", fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))},
            {"repeats", study.repeats}}},
          {"time", time},
          {"truth", facts},
          {"axes", varying_axes(study, runs)},
          {"quantities", quantities},
          {"runs", all},
          {"front", front},
          {"reach", reach}};
}

std::string study_csv(const Json& study) {
  std::string out;
  for (const Json& run : study["runs"]) {
    std::string head, line;
    for (const auto& [name, value] : columns(study, run)) {
      head += (head.empty() ? "" : ",") + csv_field(name);
      line += (line.empty() ? "" : ",") + csv_field(value);
    }
    if (out.empty()) out = head + "\n";
    out += line + "\n";
  }
  return out;
}

std::string settings_text(const Json& study, const Json& run) {
  std::string out;
  for (const auto& axis : study["axes"]) {
    const Json value = run["settings"].value(axis.get<std::string>(), Json());
    if (value.is_null()) continue;
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", axis.get<std::string>(),
                       value.is_string() ? value.get<std::string>() : value.dump());
  }
  return out;
}

std::string study_page(const Json& study) {
  // On one line; bytes that are no UTF-8 are replaced, as in study.json.
  return assemble_page(study.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string study_summary(const Json& study, std::string_view quantity) {
  const auto run_of = [&](const Json& id) {
    return *std::find_if(study["runs"].begin(), study["runs"].end(),
                         [&](const Json& run) { return run["id"] == id; });
  };
  const std::string name(quantity);
  std::string out = fmt::format("error of {}, seconds, settings that no other run beats in both\n", name);
  for (const Json& id : study["front"][name]) {
    const Json run = run_of(id);
    const auto& grey = run["greyed"];
    const bool is_grey = std::find(grey.begin(), grey.end(), name) != grey.end();
    out += fmt::format("{:>9}  {:>8}  {}{}\n", percent(*error_of(run, name)), seconds_text(seconds_of(run)),
                       settings_text(study, run), is_grey ? "  (near the truth's own uncertainty)" : "");
  }
  out += "seconds to reach\n";
  for (const Json& reach : study["reach"][name])
    out += fmt::format("{:>9}  {:>8}\n", percent(reach["error"].get<double>()),
                       reach["run"].is_null() ? "none" : seconds_text(seconds_of(run_of(reach["run"]))));
  return out;
}

}  // namespace firn
