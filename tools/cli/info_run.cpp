// The folder of a run: what of it is there, also while it still runs or after it was killed.
#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/output/point_cache.h"
#include "engine/shapes/file_bytes.h"
#include "tools/cli/info.h"
#include "tools/cli/units.h"

namespace firn {
namespace {

using nlohmann::json;

constexpr std::size_t kLastRows = 3;
constexpr const char* kEnergies[] = {"kinetic", "elastic", "gravity", "dissipated", "total"};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ExitCode::input, quoted(path) + ": " + why);
}

std::string text_of(const std::filesystem::path& file) {
  const auto bytes = read_regular_file(file);
  return {bytes.begin(), bytes.end()};
}

/// The numbers of the frames on disk, in order.
std::vector<int> frames_in(const std::filesystem::path& folder) {
  std::vector<int> out;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    int number = 0;
    const std::size_t start = name.find_first_of("0123456789");
    if (start == std::string::npos) continue;
    std::from_chars(name.data() + start, name.data() + name.size(), number);
    if (name == point_cache_name(number)) out.push_back(number);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// "1 to 40, 42".
std::string ranges(const std::vector<int>& numbers) {
  std::vector<std::string> out;
  for (std::size_t first = 0, last; first < numbers.size(); first = last + 1) {
    last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    out.push_back(first == last ? std::to_string(numbers[first])
                                : fmt::format("{} to {}", numbers[first], numbers[last]));
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

/// The rows of diagnostics.csv as objects.
std::vector<json> diagnostics_in(const std::filesystem::path& file) {
  const auto split = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells;
  };
  std::istringstream in(text_of(file));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line);
  std::vector<json> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line);
    // A run that goes on may have written half of its last row.
    if (cells.size() != names.size() || in.eof()) break;
    json& row = rows.emplace_back();
    for (std::size_t c = 0; c < cells.size(); ++c) {
      double value = 0;
      const auto end = std::from_chars(cells[c].data(), cells[c].data() + cells[c].size(), value);
      if (end.ec != std::errc{})
        fail(file, fmt::format("'{}' in column {} is no number", printable(cells[c]), printable(names[c])));
      row[names[c]] = value;
    }
  }
  return rows;
}

json record_in(const std::filesystem::path& file) {
  json record = json::parse(text_of(file), nullptr, false);
  if (record.is_discarded()) fail(file, "is damaged: no JSON");
  return record;
}

json materials_of(const json& record) {
  json out = json::array();
  for (const json& m : record.at("plan").at("materials"))
    out.push_back({{"name", m.at("name")}, {"model", m.at("model")}});
  return out;
}

json folder_json(const std::filesystem::path& folder) {
  const std::filesystem::path record_file = folder / "run.json", table_file = folder / "diagnostics.csv";
  const std::vector<int> frames = frames_in(folder);
  const bool has_record = std::filesystem::exists(record_file),
             has_table = std::filesystem::exists(table_file);
  if (frames.empty() && !has_record && !has_table)
    fail(folder, "holds no run: neither particles.0001.vdb nor run.json nor diagnostics.csv");
  json out = {{"folder", folder.string()}, {"frames", frames}, {"state", "not finished: it has no run.json"}};
  if (has_record) {
    const json record = record_in(record_file);
    try {
      for (const char* key : {"state", "particles", "steps", "threads"}) out[key] = record.at(key);
      out["title"] = record.at("plan").at("title");
      out["kernels"] = record.at("plan").at("kernels");
      out["materials"] = materials_of(record);
      out["seconds"] = record.at("seconds").at("total");
    } catch (const json::exception& problem) {
      fail(record_file, fmt::format("is not that of a run: {}", problem.what()));
    }
  }
  if (has_table) {
    std::vector<json> rows = diagnostics_in(table_file);
    if (!rows.empty() && !out.contains("particles")) out["particles"] = rows.back().value("particles", 0.0);
    rows.erase(rows.begin(), rows.end() - static_cast<std::ptrdiff_t>(std::min(kLastRows, rows.size())));
    out["last_rows"] = rows;
  }
  return out;
}

void print_folder(const json& run, std::ostream& out) {
  const auto line = [&](std::string_view what, const std::string& value) {
    out << fmt::format("  {:<10} {}\n", what, value);
  };
  const auto text = [&](const char* key) { return printable(run.at(key).get<std::string>(), 200); };
  out << (run.contains("title") ? text("title") : text("folder")) << '\n';
  const auto frames = run.at("frames").get<std::vector<int>>();
  line("state", text("state"));
  line("frames", frames.empty() ? "none" : fmt::format("{} ({})", frames.size(), ranges(frames)));
  if (run.contains("particles")) line("particles", grouped(run.at("particles").get<double>()));
  if (run.contains("materials")) {
    std::vector<std::string> names;
    for (const json& m : run.at("materials"))
      names.push_back(printable(
          fmt::format("{} ({})", m.at("name").get<std::string>(), m.at("model").get<std::string>())));
    line("materials", fmt::format("{}", fmt::join(names, ", ")));
    line("kernels", text("kernels"));
    line("took", fmt::format("{} for {} steps on {} thread{}", duration_text(run.at("seconds").get<double>()),
                             grouped(run.at("steps").get<double>()), run.at("threads").get<int>(),
                             run.at("threads").get<int>() == 1 ? "" : "s"));
  }
  if (!run.contains("last_rows") || run.at("last_rows").empty()) return;
  out << fmt::format("\n  {:>6} {:>10}", "frame", "time, s");
  for (const char* energy : kEnergies) out << fmt::format(" {:>12}", fmt::format("{}, J", energy));
  out << '\n';
  for (const json& row : run.at("last_rows")) {
    out << fmt::format("  {:>6.0f} {:>10.4g}", row.value("frame", 0.0), row.value("time", 0.0));
    for (const char* energy : kEnergies) out << fmt::format(" {:>12.5g}", row.value(energy, 0.0));
    out << '\n';
  }
}

}  // namespace

int run_folder_info(const std::filesystem::path& folder, bool as_json, std::ostream& out) {
  const json run = folder_json(folder);
  if (as_json)
    out << run.dump(2) << '\n';
  else
    print_folder(run, out);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace firn
