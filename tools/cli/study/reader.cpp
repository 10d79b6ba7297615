#include "tools/cli/study/reader.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/scene/report.h"
#include "engine/scene/scene_text.h"

namespace firn {
namespace {

/// One table of a study; remembers which keys were asked for, since all others are mistakes.
class Table {
 public:
  Table(const toml::table& table, std::string path, Report& report)
      : table_(table), path_(std::move(path)), report_(report) {}

  /// Null when the key is absent.
  const toml::node* find(std::string_view key) {
    known_.push_back(key);
    return table_.get(key);
  }
  const toml::node* require(std::string_view key, std::string_view allowed) {
    const toml::node* node = find(key);
    if (node == nullptr)
      report_.add(table_.source(), below(key), fmt::format("missing; allowed: {}", allowed));
    return node;
  }
  void refuse(const toml::node& node, std::string_view key, std::string_view allowed) {
    report_.add(node.source(), below(key), found_and_allowed(node, allowed));
  }

  std::string text(std::string_view key, const toml::node* node) {
    if (node == nullptr) return {};
    if (node->is_string()) return node->as_string()->get();
    refuse(*node, key, "a text in quotes");
    return {};
  }
  template <class T>
  void integer(std::string_view key, T& out, std::int64_t least, std::int64_t most) {
    const toml::node* node = find(key);
    if (node == nullptr) return;
    const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
    if (value && *value >= least && *value <= most) {
      out = static_cast<T>(*value);
    } else {
      refuse(*node, key, fmt::format("an integer, {} to {}", least, most));
    }
  }
  std::vector<std::string> texts(std::string_view key) {
    std::vector<std::string> out;
    const toml::node* node = find(key);
    if (node == nullptr) return out;
    constexpr std::string_view allowed = "an array of KEY=VALUE in quotes, as after --set";
    const toml::array* array = node->as_array();
    if (array == nullptr) {
      refuse(*node, key, allowed);
      return out;
    }
    for (const toml::node& element : *array)
      if (element.is_string())
        out.push_back(element.as_string()->get());
      else
        refuse(element, key, allowed);
    return out;
  }

  void report_unknown_keys() {
    for (const auto& [key, node] : table_) {
      if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
      report_.add(key.source(), below(printable(key.str())), unknown_name("key", key.str(), known_));
    }
  }

  std::string below(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  }
  const toml::table& toml() const { return table_; }
  Report& report() { return report_; }

 private:
  const toml::table& table_;
  std::string path_;
  Report& report_;
  std::vector<std::string_view> known_;
};

VectorQuantity read_displacement(Table& t) {
  const std::string allowed =
      fmt::format("[x, y, z] (m), each a number or a formula in quotes, of {}, with {}",
                  fmt::join(kTruthNames, ", "), formula_words());
  VectorQuantity out;
  const toml::node* node = t.require("displacement", allowed);
  if (node == nullptr) return out;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != 3) {
    t.refuse(*node, "displacement", allowed);
    return out;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const toml::node& element = *array->get(axis);
    const std::string key = fmt::format("displacement[{}]", axis);
    if (element.is_number()) {
      out[axis].number = element.value<double>().value_or(0);
    } else if (!element.is_string()) {
      t.refuse(element, key, allowed);
    } else {
      out[axis].formula = element.as_string()->get();
      try {
        const Formula formula(out[axis].formula, kTruthNames);
      } catch (const FormulaError& error) {
        t.report().add(
            element.source(), t.below(key),
            fmt::format("found '{}': {}; allowed: {}", printable(out[axis].formula), error.what(), allowed));
      }
    }
  }
  return out;
}

FinestRuns read_finest(Table& t) {
  FinestRuns out;
  constexpr std::string_view allowed =
      "two or three numbers > 0 (m), each the same factor smaller than the one before";
  if (const toml::node* node = t.require("cell_sizes", allowed)) {
    if (const toml::array* array = node->as_array())
      for (const toml::node& element : *array)
        out.cell_sizes.push_back(element.is_number() ? element.value<double>().value_or(0) : 0);
    const std::vector<double>& h = out.cell_sizes;
    const bool count = h.size() == 2 || h.size() == 3;
    bool sound = count && std::all_of(h.begin(), h.end(), [](double x) { return x > 0 && std::isfinite(x); });
    sound = sound && h[1] < 0.95 * h[0];
    // Written numbers have few digits.
    if (sound && h.size() == 3) sound = std::abs(h[1] / h[0] - h[2] / h[1]) < 0.02 * h[1] / h[0];
    if (!sound) t.refuse(*node, "cell_sizes", allowed);
  }
  out.set = t.texts("set");
  return out;
}

void read_truth(Table& study, StudyDescription& out) {
  constexpr std::string_view allowed = "a table [truth] with type = \"closed_form\" or \"finest\"";
  const toml::node* node = study.require("truth", allowed);
  if (node == nullptr) return;
  if (!node->is_table()) return study.refuse(*node, "truth", allowed);
  Table t(*node->as_table(), "truth", study.report());
  constexpr std::array<std::string_view, 2> types = {"closed_form", "finest"};
  const toml::node* type = t.require("type", "\"closed_form\" or \"finest\"");
  if (type == nullptr) return;
  const std::string word = t.text("type", type);
  if (word == types[0]) {
    out.truth = ClosedForm{read_displacement(t)};
  } else if (word == types[1]) {
    out.truth = read_finest(t);
  } else {
    if (type->is_string())
      study.report().add(type->source(), "truth.type", unknown_name("type", word, types));
    return;  // which keys it may have cannot be told
  }
  t.report_unknown_keys();
}

/// As it would stand in a scene; also JSON, where JSON has such values.
std::string toml_text(const toml::node& node) {
  if (node.is_string()) return nlohmann::json(node.as_string()->get()).dump();
  if (node.is_floating_point()) return fmt::format("{}", node.as_floating_point()->get());
  std::ostringstream out;
  node.visit([&](const auto& value) { out << toml::toml_formatter{value}; });
  return out.str();
}

Sweep read_sweep(const toml::table& table, std::string path, Report& report) {
  Sweep sweep;
  Table t(table, std::move(path), report);
  t.integer("sample", sweep.sample, 1, 1000000);
  constexpr std::string_view allowed = "an array of one value or more";
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table)
    if (key.str() != "sample") entries.emplace_back(&key, &node);
  // In the order of the text; TOML's tables are sorted by name.
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto place = [](const toml::source_position& at) { return std::pair(at.line, at.column); };
    return place(a.first->source().begin) < place(b.first->source().begin);
  });
  for (const auto& [key, node] : entries) {
    const toml::array* array = node->as_array();
    if (array == nullptr || array->empty()) {
      t.refuse(*node, printable(key->str()), allowed);
      continue;
    }
    Axis& axis = sweep.axes.emplace_back(Axis{std::string(key->str()), {}, report.mark(key->source())});
    for (const toml::node& element : *array) axis.values.push_back(toml_text(element));
  }
  if (sweep.axes.empty()) report.add(table.source(), t.below(""), "no setting; allowed: one or more");
  return sweep;
}

void read_sweeps(Table& study, StudyDescription& out) {
  constexpr std::string_view allowed = "one table [[sweeps]] or more";
  const toml::node* node = study.require("sweeps", allowed);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty()) return study.refuse(*node, "sweeps", allowed);
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::table* table = array->get(i)->as_table();
    if (table == nullptr) {
      study.refuse(*array->get(i), "sweeps", allowed);
    } else {
      out.sweeps.push_back(read_sweep(*table, fmt::format("sweeps[{}]", i), study.report()));
    }
  }
}

}  // namespace

StudyDescription read_study(const std::filesystem::path& path) {
  StudyDescription out;
  out.file = path;
  Report report(shown_path(path));
  if (const auto table = parse_toml(read_scene_file(path), report.file(), report)) {
    Table t(*table, "", report);
    out.title = t.text("title", t.find("title"));
    out.description = t.text("description", t.find("description"));
    const std::string scene =
        t.text("scene", t.require("scene", "the name of a scene file, relative to the study"));
    out.scene = path.parent_path() / scene;
    out.set = t.texts("set");
    t.integer("repeats", out.repeats, 1, 1000);
    t.integer("threads", out.threads, 1, 1024);
    t.integer("seed", out.seed, 0, std::numeric_limits<std::int64_t>::max());
    read_truth(t, out);
    read_sweeps(t, out);
    t.report_unknown_keys();
  }
  report.throw_if_any();
  return out;
}

std::string example_study() {
  return R"toml(# A study: what accuracy costs. Run it with firn study FILE.
title = "Two cylinders"
description = "Which settings are cheapest at which error?"
scene = "../../scenes/two_cylinders.toml"   # relative to this file
set = ["simulation.duration=1"]             # on every run, as after firn run ... --set
repeats = 5                                 # of every run; the median of their seconds counts
threads = 1                                 # of every run that does not say otherwise
seed = 1                                    # of samples

[truth]
type = "finest"                             # what ever finer runs tend to (Richardson's extrapolation)
cell_sizes = [0.025, 0.0125, 0.00625]       # two or three, each the same factor smaller
set = ["simulation.kernel=quadratic"]       # beside those above
# Or a displacement that is known; velocity and stress follow from it:
#type = "closed_form"
#displacement = ["0.1 * sin(pi * t) * cos(pi * X)", 0, 0]   # m, of X, Y, Z, t

# Every combination of the values; several sweeps are put together. A combination that a scene may not have, such
# as APIC with the linear kernel, is listed and not run.
[[sweeps]]
cell_size = [0.1, 0.05]                     # cell_size and all other keys of [simulation]
kernel = ["linear", "quadratic"]
particles_per_cell = [4, 16]                # of all bodies
threads = [1]
"materials.rubber.youngs_modulus" = [1e3]   # any key of the scene
#sample = 20                                # so many of the combinations, at random
)toml";
}

}  // namespace firn
