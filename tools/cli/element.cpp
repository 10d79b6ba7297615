#include "tools/cli/element.h"

#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "materials/tangent.h"
#include "tools/cli/element_point.h"
#include "tools/cli/element_request.h"
#include "tools/cli/json_line.h"

namespace firn {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

template <int D>
json rows_of(const Matrix<double, D>& m) {
  json out = json::array();
  for (const auto& row : m.m) out.push_back(row);
  return out;
}

template <int D, class Model>
ordered_json answer(const Model& model, const ElementRequest& request) {
  using Energy = typename Model::Energy;
  auto point = model.template at_rest<double, D>();
  Matrix<double, D> F_P = to_matrix<D>(request.F_P);
  point.F_E = to_matrix<D>(request.F_trial);
  if constexpr (has_plastic_part<decltype(point)>) point.F_P = F_P;
  visit_history<Model>(point, [&](const std::string& name, double& value) {
    if (const auto given = request.state.find(name); given != request.state.end()) value = given->second;
  });
  const auto trial = point;

  const Response<double, D> response = model.update(point, request.dt);
  const Lame<double> moduli = model.current_moduli(point);
  if constexpr (has_plastic_part<decltype(point)>) F_P = point.F_P;

  ordered_json out;
  out["branch"] = branch_of<D>(model, trial, request.dt);
  out["psi"] = model.energy(point);
  out["P"] = rows_of(first_piola<Energy>(point.F_E, moduli));
  out["tau"] = rows_of(response.tau);
  out["F_E"] = rows_of(point.F_E);
  out["F_P"] = rows_of(F_P);
  out["state"] = ordered_json::object();
  if constexpr (has_plastic_part<decltype(point)>)
    // From the singular values: a determinant by cofactors cancels when F_P is ill-conditioned.
    out["state"] = {{"J_P", product(svd(F_P).s)}, {"mu", moduli.mu}, {"lam", moduli.lam}};
  visit_history<Model>(point, [&](const std::string& name, double value) { out["state"][name] = value; });
  out["wave_modulus"] = response.wave_modulus;
  out["dissipated"] = response.dissipated;
  out["capped"] = response.capped > 0;
  if (request.tangent) out["dPdF"] = tangent<Energy>(point.F_E, moduli);
  return out;
}

ordered_json answer(const ElementRequest& request) {
  return std::visit(
      [&](const auto& model) {
        switch (request.dimension()) {
          case 1:
            return answer<1>(model, request);
          case 2:
            return answer<2>(model, request);
          default:
            return answer<3>(model, request);
        }
      },
      request.material);
}

bool all_finite(const ordered_json& value) {
  if (value.is_number_float()) return std::isfinite(value.get<double>());
  for (const auto& child : value)
    if (value.is_structured() && !all_finite(child)) return false;
  return true;
}

// The line's own name for itself, if it has got as far as having one.
json id_of(const json& line) {
  if (!line.is_object() || !line.contains("id")) return nullptr;
  const json& id = line.at("id");
  return id.is_primitive() ? id : json(nullptr);
}

// False when the line was bad.
bool answer_line(const std::string& text, std::ostream& out) {
  ordered_json reply;
  bool good = true;
  try {
    const json line = parse_json_line(text);
    reply["id"] = id_of(line);
    reply.update(answer(parse_element_request(line)));
    if (!all_finite(reply))
      throw Error(ExitCode::input, "F_trial or F_P is so large that the answer overflows");
  } catch (const Error& e) {
    const json id = reply.contains("id") ? json(reply["id"]) : json(nullptr);
    reply = {{"id", id}, {"error", e.what()}};
    good = false;
  }
  out << reply.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
  return good;
}

}  // namespace

int run_element(std::istream& in, std::ostream& out) {
  bool good = true;
  std::string line;
  while (read_bounded_line(in, line)) {
    const bool blank =
        line.size() <= kLongestJsonLine && line.find_first_not_of(" \t\r") == std::string::npos;
    if (blank) continue;
    good = answer_line(line, out) && good;
    // A program on the other end of a pipe waits for each answer.
    out.flush();
  }
  return static_cast<int>(good ? ExitCode::ok : ExitCode::input);
}

}  // namespace firn
