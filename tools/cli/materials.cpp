#include "tools/cli/materials.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "materials/model_info.h"
#include "materials/presets.h"

namespace firn {
namespace {

std::string default_of(const Parameter& p) {
  return p.required() ? "required" : p.text(p.default_value);
}

std::string columns_of(const ModelInfo& m) {
  std::vector<std::string_view> symbols;
  for (int c = 0; c < kColumnCount; ++c)
    if (m.columns.has(static_cast<Column>(c))) symbols.push_back(info(static_cast<Column>(c)).symbol);
  return fmt::format("{}", fmt::join(symbols, ", "));
}

std::string parts_of(const ModelInfo& m) {
  std::string out{m.energy};
  if (m.yield != "none") out += fmt::format(" + {}", m.yield);
  if (m.hardening != "none")
    out += fmt::format(" + {}{}", m.hardening, m.hardening.ends_with("softening") ? "" : " hardening");
  if (m.rate != "none") out += fmt::format(" + {} rate", m.rate);
  return out;
}

// Cells padded to the widest of their column, two spaces apart; the last column runs free.
void print_table(const std::vector<std::vector<std::string>>& rows, std::ostream& out) {
  std::vector<std::size_t> width(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  for (const auto& row : rows) {
    std::string line = "  ";
    for (std::size_t c = 0; c + 1 < row.size(); ++c) line += fmt::format("{:<{}}  ", row[c], width[c]);
    out << line << row.back() << '\n';
  }
}

void print_model(const ModelInfo& m, std::ostream& out) {
  out << fmt::format("{}\n  {}\n", m.name, m.title);
  print_table({{"source", std::string(m.source)},
               {"parts", parts_of(m)},
               {"columns", columns_of(m)},
               {"decomposition per update", std::string(m.decomposition)}},
              out);
  std::vector<std::vector<std::string>> rows = {{"parameter", "unit", "default", "allowed", "meaning"}};
  for (const Parameter& p : m.parameters)
    rows.push_back(
        {std::string(p.name), std::string(p.unit), default_of(p), p.range(), std::string(p.meaning)});
  print_table(rows, out);
}

void print_preset(const Preset& p, std::ostream& out) {
  out << fmt::format("{}\n  {}\n", p.name, p.look);
  std::vector<std::string> values;
  for (const auto& [name, value] : p.values) values.push_back(fmt::format("{} = {:g}", name, value));
  print_table({{"model", std::string(p.model)},
               {"source", std::string(p.source)},
               {"numbers", fmt::format("{}", fmt::join(values, ", "))}},
              out);
}

}  // namespace

int run_materials(const std::string& name, std::ostream& out) {
  if (!name.empty()) {
    const ModelInfo* m = find_model(name);
    const Preset* p = find_preset(name);
    std::vector<std::string_view> known;
    for (const ModelInfo& other : models()) known.push_back(other.name);
    for (const Preset& other : presets()) known.push_back(other.name);
    if (!m && !p) throw Error(ExitCode::input, unknown_name("model or preset", name, known));
    m ? print_model(*m, out) : print_preset(*p, out);
    return static_cast<int>(ExitCode::ok);
  }
  for (const ModelInfo& m : models()) {
    print_model(m, out);
    out << '\n';
  }
  out << "Presets, which a scene's material may name in place of a model:\n";
  for (const Preset& p : presets()) {
    out << '\n';
    print_preset(p, out);
  }
  return static_cast<int>(ExitCode::ok);
}

int run_materials_markdown(std::ostream& out) {
  out << "| model | what it is | source | parts | columns | parameters (default) "
         "|\n|---|---|---|---|---|---|\n";
  for (const ModelInfo& m : models()) {
    std::vector<std::string> parameters;
    for (const Parameter& p : m.parameters)
      parameters.push_back(fmt::format("`{}` ({})", p.name, default_of(p)));
    out << fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", m.name, m.title, m.source, parts_of(m),
                       columns_of(m), fmt::join(parameters, ", "));
  }
  out << "\n| preset | look | model | source of its numbers |\n|---|---|---|---|\n";
  for (const Preset& p : presets())
    out << fmt::format("| `{}` | {} | `{}` | {} |\n", p.name, p.look, p.model, p.source);
  return static_cast<int>(ExitCode::ok);
}

}  // namespace firn
