#include "tools/cli/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "engine/base/parallel.h"
#include "engine/scene/reader.h"
#include "materials/model_info.h"
#include "tools/cli/units.h"

namespace firn {
namespace {

std::string_view name(Transfer t) {
  switch (t) {
    case Transfer::pic:
      return "PIC";
    case Transfer::flip:
      return "FLIP";
    case Transfer::mls:
      return "MLS";
    case Transfer::apic:
      break;
  }
  return "APIC";
}
std::string_view name(Contact c) {
  return c == Contact::sticky ? "sticky" : c == Contact::slip ? "slip" : "separating";
}

struct Effect {
  std::string name;
  bool present;
  std::string detail;  // what it is, or what its absence saves
};

std::vector<Effect> effects(const Plan& plan) {
  const auto any = [&](auto&& test) { return std::any_of(plan.batches.begin(), plan.batches.end(), test); };
  const auto info_of = [](const BatchPlan& b) { return find_model(b.model); };
  const bool plastic = any([&](const auto& b) { return info_of(b)->yield != "none"; });
  // The laws of one kind that the materials have, each once.
  const auto laws = [&](std::string_view ModelInfo::*kind) {
    std::vector<std::string_view> out;
    for (const BatchPlan& b : plan.batches) {
      const std::string_view law = info_of(b)->*kind;
      if (law != "none" && std::find(out.begin(), out.end(), law) == out.end()) out.push_back(law);
    }
    return fmt::format("{}", fmt::join(out, ", "));
  };
  const std::string hardening = laws(&ModelInfo::hardening), rate = laws(&ModelInfo::rate);
  const bool decomposes = any([&](const auto& b) { return info_of(b)->decomposition != "none"; });
  const GridEffects& grid = plan.effects;
  const bool friction =
      (grid.domain && grid.domain->friction > 0) ||
      std::any_of(grid.colliders.begin(), grid.colliders.end(), [](const auto& c) { return c.friction > 0; });
  const bool keyframes = std::any_of(plan.scene.colliders.begin(), plan.scene.colliders.end(),
                                     [](const auto& c) { return !c.keyframes.empty(); });
  std::vector<std::string> colliders;
  for (const Collider& c : grid.colliders)
    colliders.push_back(fmt::format("{} ({})", c.name, name(c.contact)));
  std::vector<std::string> loads;
  for (const Load& load : plan.forces.loads) loads.push_back(load.name);
  const bool affine =
      plan.scene.simulation.transfer == Transfer::apic || plan.scene.simulation.transfer == Transfer::mls;
  const bool increments = plan.scene.simulation.transfer == Transfer::flip;
  return {
      {"plasticity", plastic, plastic ? "return map each step, F_P stored" : "no return map, no F_P"},
      {"hardening", !hardening.empty(), hardening.empty() ? "moduli and strengths are constants" : hardening},
      {"rate", !rate.empty(), rate.empty() ? "no flow depends on time" : rate},
      {"decomposition", decomposes,
       decomposes ? "one SVD of F_E a particle and step" : "no SVD, no polar decomposition"},
      {"affine velocity", affine, affine ? "C stored" : "no C"},
      {"velocity increments", increments, increments ? "second grid velocity" : "one grid velocity"},
      {"gravity", grid.gravity.has_value(), grid.gravity ? "every node" : "no pass"},
      {"body force", plan.forces.acceleration.has_value(),
       plan.forces.acceleration ? "every particle, f stored" : "no pass"},
      {"loads", !plan.forces.loads.empty(),
       plan.forces.loads.empty() ? "no pass" : fmt::format("{}", fmt::join(loads, ", "))},
      {"colliders", !grid.colliders.empty(),
       grid.colliders.empty() ? "no pass" : fmt::format("{}", fmt::join(colliders, ", "))},
      {"moving colliders", keyframes, keyframes ? "posed each step" : "nothing moves"},
      {"friction", friction, friction ? "Coulomb" : "none"},
      {"domain walls", grid.domain.has_value(),
       grid.domain ? std::string(name(grid.domain->contact)) : "no pass"},
  };
}

std::vector<std::string> column_symbols(ColumnSet columns, bool present) {
  std::vector<std::string> out;
  for (int c = 0; c < kColumnCount; ++c)
    if (columns.has(static_cast<Column>(c)) == present) out.emplace_back(info(static_cast<Column>(c)).symbol);
  return out;
}

std::size_t bytes_per_particle(const Plan& plan, const BatchPlan& batch) {
  const std::size_t real = plan.scene.simulation.precision == Precision::double_ ? 8 : 4;
  return static_cast<std::size_t>(batch.columns.reals(plan.dimension())) * real + sizeof(std::uint32_t);
}

std::string kernels(const Plan& plan) {
  const SimulationDescription& s = plan.scene.simulation;
  const std::string_view kernel = s.kernel == KernelName::linear  ? "linear"
                                  : s.kernel == KernelName::gimp  ? "GIMP"
                                  : s.kernel == KernelName::cubic ? "cubic B-spline"
                                                                  : "quadratic B-spline";
  const std::string_view order = s.stress_order == StressOrder::usf   ? "USF"
                                 : s.stress_order == StressOrder::usl ? "USL"
                                                                      : "MUSL";
  return fmt::format("{}D, {}, {}, {}, {}, {} ({})", s.dimension, kernel, name(s.transfer), order,
                     s.precision == Precision::double_ ? "double" : "float",
                     plan.path.isa ? fmt::format("vectorised path, {}", name(*plan.path.isa)) : "plain path",
                     plan.path.reason);
}

}  // namespace

nlohmann::json plan_json(const Plan& plan, const Estimate& e) {
  nlohmann::json out;
  out["scene"] = plan.scene.file.string();
  out["title"] = plan.scene.title;
  out["kernels"] = kernels(plan);
  for (const Effect& effect : effects(plan)) {
    out["effects"][effect.present ? "present" : "absent"].push_back(effect.name);
    out["effect_detail"][effect.name] = effect.detail;
  }
  for (const BatchPlan& batch : plan.batches) {
    const ModelInfo& model = *find_model(batch.model);
    out["materials"].push_back({{"name", batch.material},
                                {"model", batch.model},
                                {"energy", model.energy},
                                {"yield", model.yield},
                                {"hardening", model.hardening},
                                {"rate", model.rate},
                                {"decomposition", model.decomposition},
                                {"columns", column_symbols(batch.columns, true)},
                                {"absent_columns", column_symbols(batch.columns, false)},
                                {"bytes_per_particle", bytes_per_particle(plan, batch)}});
  }
  for (std::size_t b = 0; b < plan.bodies.size(); ++b)
    out["bodies"].push_back({{"name", plan.scene.bodies[b].name},
                             {"material", plan.scene.bodies[b].material.text},
                             {"particles", std::round(e.particles[b])}});
  out["estimate"] = {{"particles", std::round(e.total_particles)},
                     {"blocks", std::round(e.blocks)},
                     {"particle_bytes", e.particle_bytes},
                     {"grid_bytes", e.grid_bytes},
                     {"peak_bytes", e.peak_bytes},
                     {"frames", plan.frames()},
                     {"disk_bytes", e.disk_bytes},
                     {"wave_speed", e.wave_speed},
                     {"dt", e.dt},
                     {"steps", e.steps},
                     {"core_seconds", e.core_seconds}};
  out["warnings"] = plan.warnings;
  return out;
}

void print_plan(const Plan& plan, const Estimate& e, std::ostream& out) {
  const auto line = [&](std::string_view label, const std::string& text) {
    out << fmt::format("{:<12} {}\n", label, text);
  };
  line("scene", fmt::format("{}{}", plan.scene.file.string(),
                            plan.scene.title.empty() ? "" : ": " + plan.scene.title));
  line("kernels", kernels(plan));
  out << "\neffects\n";
  for (const Effect& effect : effects(plan))
    out << fmt::format("  {} {:<20} {}\n", effect.present ? "+" : "-", effect.name, effect.detail);
  out << "\nmaterials\n";
  for (const BatchPlan& batch : plan.batches) {
    const ModelInfo& model = *find_model(batch.model);
    out << fmt::format("  {}: {} (energy {}, yield {}, hardening {}, decomposition {})\n", batch.material,
                       batch.model, model.energy, model.yield, model.hardening, model.decomposition);
    out << fmt::format("    columns {}: {} bytes a particle; absent: {}\n",
                       fmt::join(column_symbols(batch.columns, true), " "), bytes_per_particle(plan, batch),
                       fmt::join(column_symbols(batch.columns, false), " "));
  }
  out << "\nbodies\n";
  for (std::size_t b = 0; b < plan.bodies.size(); ++b)
    out << fmt::format("  {}: about {} particles of {}\n", plan.scene.bodies[b].name, grouped(e.particles[b]),
                       plan.scene.bodies[b].material.text);
  out << "\nestimate\n";
  const int threads = default_threads();
  line("  particles", grouped(e.total_particles));
  line("  blocks",
       fmt::format("{} of {} nodes at the start", grouped(e.blocks), power(kBlockEdge, plan.dimension())));
  line("  memory", fmt::format("{} particles, {} grid, {} at most", bytes_text(e.particle_bytes),
                               bytes_text(e.grid_bytes), bytes_text(e.peak_bytes)));
  line("  disk", fmt::format("{} for {} frames", bytes_text(e.disk_bytes), plan.frames()));
  line(
      "  dt",
      fmt::format("{:.3g} s at the start (P-wave {:.3g} m/s, fastest body {:.3g} m/s); hardening and impacts "
                  "shorten it",
                  e.dt, e.wave_speed, e.speed));
  line("  steps", fmt::format("at least {}", grouped(e.steps)));
  line("  time", fmt::format("at least {} on {} core{}", duration_text(e.core_seconds / threads), threads,
                             threads > 1 ? "s" : ""));
  for (const std::string& warning : plan.warnings) out << "warning: " << warning << '\n';
}

int run_plan(const std::filesystem::path& scene, const std::vector<std::string>& overrides, bool json,
             std::ostream& out) {
  const Plan plan = make_plan(read_scene(scene, overrides));
  const Estimate e = estimate(plan);
  if (json)
    out << plan_json(plan, e).dump(2) << '\n';
  else
    print_plan(plan, e, out);
  return 0;
}

}  // namespace firn
