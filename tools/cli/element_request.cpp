#include "tools/cli/element_request.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "materials/model_info.h"
#include "tools/cli/element_point.h"

namespace firn {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ExitCode::input, message);
}

std::string shown(const json& value) {
  return printable(value.dump(-1, ' ', false, json::error_handler_t::replace), 60);
}

double number(const std::string& key, const json& value) {
  if (value == "inf") return std::numeric_limits<double>::infinity();
  if (!value.is_number()) refuse(fmt::format("{}: found {}; a number is needed", key, shown(value)));
  return value.get<double>();
}

void check_keys(std::string_view what, const json& object, const std::vector<std::string_view>& known) {
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end()) refuse(unknown_name(what, key, known));
}

const ModelInfo& find_model_in(const json& material) {
  if (!material.contains("model")) refuse("material.model: is missing");
  const json& name = material.at("model");
  if (!name.is_string()) refuse(fmt::format("material.model: found {}; a name is needed", shown(name)));
  if (const ModelInfo* m = find_model(name.get<std::string>())) return *m;
  std::vector<std::string_view> known;
  for (const ModelInfo& m : models()) known.push_back(m.name);
  refuse("material.model: " + unknown_name("model", name.get<std::string>(), known));
}

// mu with lam or kappa (of d dimensions) may stand in place of youngs_modulus and poissons_ratio; mu alone
// means lam = 0, for models that keep the volume and do not care.
std::optional<Lame<double>> lame_in(const json& material, std::size_t dimension) {
  const bool mu = material.contains("mu"), lam = material.contains("lam"), kappa = material.contains("kappa");
  if (!mu && !lam && !kappa) return std::nullopt;
  if (!mu) refuse("material.mu: is missing; mu goes with lam or kappa");
  if (lam && kappa) refuse("material.kappa: give either it or lam");
  for (const char* other : {"youngs_modulus", "poissons_ratio"})
    if (material.contains(other)) refuse(fmt::format("material.{}: give either it or mu and lam", other));
  Lame<double> m = {number("material.mu", material.at("mu")), 0};
  if (!(m.mu > 0 && m.mu <= 1e15)) refuse(fmt::format("material.mu: found {}; allowed: in (0, 1e+15]", m.mu));
  if (kappa) {
    const double bulk = number("material.kappa", material.at("kappa"));
    if (!(bulk > 0 && bulk <= 1e15))
      refuse(fmt::format("material.kappa: found {}; allowed: in (0, 1e+15]", bulk));
    m.lam = bulk - 2 * m.mu / static_cast<double>(dimension);
  } else if (lam) {
    m.lam = number("material.lam", material.at("lam"));
    if (!(3 * m.lam > -2 * m.mu && m.lam <= 1e15))
      refuse(fmt::format("material.lam: found {}; allowed: in (-2/3 mu, 1e+15]", m.lam));
  }
  return m;
}

double chosen_value(const Parameter& p, const std::string& key, const json& value) {
  if (p.is_switch() && value.is_boolean()) return value.get<bool>() ? 1 : 0;
  for (std::size_t k = 0; !p.is_switch() && k < p.choices.size(); ++k)
    if (value == p.choices[k]) return static_cast<double>(k);
  refuse(fmt::format("{}: found {}; allowed: {}", key, shown(value), p.range()));
}

double parameter_value(const Parameter& p, const json& material, bool unused) {
  const std::string key = fmt::format("material.{}", p.name);
  const auto found = material.find(std::string(p.name));
  if (found == material.end()) {
    if (p.required() && !unused) refuse(fmt::format("{}: is missing; {}, {}", key, p.meaning, p.range()));
    return p.required() ? 0 : p.default_value;
  }
  if (!p.choices.empty()) return chosen_value(p, key, *found);
  const double value = number(key, *found);
  if (!p.allows(value)) refuse(fmt::format("{}: found {}; allowed: {}", key, value, p.range()));
  return value;
}

Material material_in(const json& line, std::size_t dimension) {
  if (!line.contains("material")) refuse("material: is missing");
  const json& material = line.at("material");
  if (!material.is_object()) refuse(fmt::format("material: found {}; an object is needed", shown(material)));
  const ModelInfo& model = find_model_in(material);
  std::vector<std::string_view> known = {"model", "mu", "lam", "kappa"};
  for (const Parameter& p : model.parameters) known.push_back(p.name);
  check_keys(fmt::format("parameter of '{}'", model.name), material, known);

  const std::optional<Lame<double>> given = lame_in(material, dimension);
  ParameterValues values;
  for (const Parameter& p : model.parameters) {
    // A single point has no mass, so a line need not give the density.
    const bool unused = p.name == "density" || given.has_value();
    values.emplace(p.name, parameter_value(p, material, unused));
  }
  Material out = make_material(model.name, values);
  if (given) std::visit([&](auto& m) { m.moduli = *given; }, out);
  return out;
}

Rows rows_in(const std::string& key, const json& value, std::size_t d) {
  const auto bad = [&] {
    refuse(fmt::format("{}: found {}; {} rows of {} numbers are needed", key, shown(value), d, d));
  };
  if (!value.is_array() || value.size() != d) bad();
  Rows out;
  for (const json& row : value) {
    if (!row.is_array() || row.size() != d) bad();
    out.emplace_back();
    for (const json& x : row) {
      if (!x.is_number()) bad();
      out.back().push_back(x.get<double>());
      if (!std::isfinite(out.back().back()))
        refuse(fmt::format("{}: holds a number that is not finite", key));
    }
  }
  return out;
}

std::size_t dimension_in(const json& line) {
  if (!line.contains("F_trial")) refuse("F_trial: is missing");
  if (!line.contains("dimension")) {
    const std::size_t rows = line.at("F_trial").is_array() ? line.at("F_trial").size() : 0;
    if (rows < 1 || rows > 3)
      refuse(fmt::format("F_trial: found {}; 1, 2 or 3 rows are needed", shown(line.at("F_trial"))));
    return rows;
  }
  const json& d = line.at("dimension");
  if (d != 1 && d != 2 && d != 3) refuse(fmt::format("dimension: found {}; allowed: 1, 2, 3", shown(d)));
  return d.get<std::size_t>();
}

std::map<std::string, double> state_in(const json& line, const ModelInfo& model) {
  std::map<std::string, double> out;
  if (!line.contains("state")) return out;
  const json& state = line.at("state");
  if (!state.is_object()) refuse(fmt::format("state: found {}; an object is needed", shown(state)));
  std::vector<std::string_view> known;
  for (const Column c : {Column::hardening, Column::volume_gain})
    if (model.columns.has(c)) known.push_back(history_name(model, c));
  if (known.empty() && !state.empty())
    refuse(fmt::format("state: unknown key '{}'; this model's whole state is F_P",
                       printable(state.begin().key())));
  check_keys("state", state, known);
  for (const auto& [key, value] : state.items()) {
    out[key] = number("state." + key, value);
    if (!std::isfinite(out[key])) refuse(fmt::format("state.{}: is not finite", key));
  }
  return out;
}

}  // namespace

std::string_view history_name(const ModelInfo& model, Column column) {
  if (column == Column::volume_gain) return info(column).symbol;
  return model.columns.has(Column::volume_gain) ? "q" : info(column).symbol;
}

ElementRequest parse_element_request(const json& line) {
  if (!line.is_object()) refuse(fmt::format("found {}; an object is needed", shown(line)));
  check_keys("key", line, {"id", "dimension", "dt", "material", "F_trial", "F_P", "state", "tangent"});
  const std::size_t d = dimension_in(line);
  ElementRequest out{material_in(line, d), 1e-3, rows_in("F_trial", line.at("F_trial"), d), {}, {}, false};
  out.state = state_in(line, find_model_in(line.at("material")));
  if (line.contains("dt")) out.dt = number("dt", line.at("dt"));
  if (!(out.dt >= 0 && std::isfinite(out.dt))) refuse(fmt::format("dt: found {}; allowed: >= 0", out.dt));
  if (line.contains("tangent")) {
    if (!line.at("tangent").is_boolean()) refuse("tangent: allowed: true, false");
    out.tangent = line.at("tangent").get<bool>();
  }
  if (line.contains("F_P")) {
    out.F_P = rows_in("F_P", line.at("F_P"), d);
  } else {
    out.F_P.assign(d, std::vector<double>(d, 0));
    for (std::size_t i = 0; i < d; ++i) out.F_P[i][i] = 1;
  }
  return out;
}

}  // namespace firn
