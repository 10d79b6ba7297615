#include "tools/cli/costs.h"

#include <algorithm>

#include <fmt/format.h>

#include "materials/model_info.h"

namespace firn {
namespace {

/// What a material's updates consist of.
std::vector<std::string> effects_of(const Plan& plan, const std::string& material) {
  const auto batch = std::find_if(plan.batches.begin(), plan.batches.end(),
                                  [&](const BatchPlan& b) { return b.material == material; });
  const ModelInfo& model = *find_model(batch->model);
  std::vector<std::string> out{"elasticity"};
  if (model.decomposition != "none") out.emplace_back("decomposition");
  if (model.yield != "none") out.emplace_back("plasticity");
  if (model.hardening != "none") out.emplace_back("hardening");
  if (model.rate != "none") out.emplace_back("rate");
  return out;
}

}  // namespace

nlohmann::json costs_json(const Plan& plan, const Simulation& simulation, std::int64_t steps,
                          const FrameWriter::Times& writing) {
  std::vector<Cost> costs = simulation.costs();
  // What the simulation itself spends on caches: the copy of a frame, and waiting for the disk.
  costs.push_back({"caches", {}, "frame", writing.snapshot + writing.wait, 0});
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost& a, const Cost& b) { return a.seconds > b.seconds; });
  double all = 0;
  for (const Cost& c : costs) all += c.seconds;
  const double particles = static_cast<double>(simulation.particles());
  const double updates = particles * static_cast<double>(steps);
  auto out = nlohmann::json::array();
  for (const Cost& c : costs) {
    nlohmann::json entry = {{"part", c.part}};
    if (!c.kind.empty()) entry["kind"] = c.kind;
    if (c.kind == "material") entry["effects"] = effects_of(plan, c.part);
    entry["passes"] = c.passes;
    entry["seconds"] = c.seconds;
    entry["share"] = all > 0 ? c.seconds / all : 0;
    entry["ns_per_particle_step"] = updates > 0 ? 1e9 * c.seconds / updates : 0;
    entry["bytes"] = c.bytes;
    entry["bytes_per_particle"] = particles > 0 ? static_cast<double>(c.bytes) / particles : 0;
    out.push_back(entry);
  }
  return out;
}

std::string costs_line(const nlohmann::json& costs) {
  constexpr double kHidden = 0.005;  // would be printed as 0 %
  std::string out;
  for (const auto& cost : costs) {
    const double share = cost["share"].get<double>();
    const std::string part = cost["part"].get<std::string>();
    if (part == "particles") continue;  // take memory, but no time of their own
    if (!out.empty()) out += ", ";
    if (part == "caches" && share < kHidden) {
      out += "caches hidden";
      continue;
    }
    out += fmt::format("{}{} {:.0f} %", cost.value("kind", "") == "collider" ? "collider " : "", part,
                       100 * share);
    if (cost.contains("effects"))
      out += fmt::format(" ({})", fmt::join(cost["effects"].get<std::vector<std::string>>(), ", "));
  }
  return out;
}

}  // namespace firn
