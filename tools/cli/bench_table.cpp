#include "tools/cli/bench_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

Json without_nulls(const Json& row) {
  Json out = Json::object();
  for (const auto& [key, value] : row.items())
    if (!value.is_null()) out[key] = value.is_object() ? without_nulls(value) : value;
  return out;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return quoted(value.get<std::string>());
  return value.is_number_float() ? fmt::format("{:.5g}", value.get<double>()) : value.dump();
}

/// f(column, value) for each cell of a row.
template <class F>
void for_cells(const Json& row, F&& f) {
  for (const auto& [key, value] : row.items()) {
    if (!value.is_object()) {
      f(key, value);
      continue;
    }
    for (const auto& [inner, part] : value.items()) f(key + '.' + inner, part);
  }
}

}  // namespace

void print_json(const BenchRows& rows, std::ostream& out) {
  // A scene's name may hold anything.
  for (const Json& row : rows)
    out << without_nulls(row).dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_csv(const BenchRows& rows, std::ostream& out) {
  std::vector<std::string> columns;
  for_cells(rows.front(), [&](const std::string& column, const Json&) { columns.push_back(column); });
  out << fmt::format("{}\n", fmt::join(columns, ","));
  for (const Json& row : rows) {
    std::vector<std::string> cells;
    for_cells(row, [&](const std::string&, const Json& value) { cells.push_back(cell(value)); });
    out << fmt::format("{}\n", fmt::join(cells, ","));
  }
}

}  // namespace firn
