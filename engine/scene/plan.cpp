#include "engine/scene/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>

#include "engine/passes/transfer.h"
#include "engine/scene/build_shape.h"
#include "materials/model_info.h"

namespace firn {
namespace {

ColumnSet transfer_columns(Transfer transfer) {
  switch (transfer) {
    case Transfer::pic:
      return kTransferColumns | PicTransfer::columns;
    case Transfer::flip:
      return kTransferColumns | FlipTransfer::columns;
    case Transfer::mls:
      return kTransferColumns | MlsTransfer::columns;
    case Transfer::apic:
      break;
  }
  return kTransferColumns | ApicTransfer::columns;
}

PathPlan plan_path(const SceneDescription& scene) {
  const SimulationDescription& s = scene.simulation;
  if (s.path == PathChoice::plain) return {{}, "simulation.path = \"plain\""};
  if (s.dimension == 1) return {{}, "the vectorised path has no 1D"};
  if (s.kernel != KernelName::quadratic) return {{}, "the vectorised path has the quadratic kernel only"};
  if (s.stress_order != StressOrder::usl) return {{}, "the vectorised path has stress_order \"usl\" only"};
  if (s.transfer == Transfer::flip) return {{}, "FLIP needs every particle's velocity in every step"};
  if (scene.names_forces()) return {{}, "the vectorised path has no forces on particles"};
  if (mass_cutoff(s) > 0) return {{}, "the vectorised path ignores no node"};
  const std::optional<Isa> isa = best_isa();
  if (!isa) return {{}, "the processor has no SSE4, or FIRN_ISA = none"};
  return {isa, std::getenv("FIRN_ISA") != nullptr ? "FIRN_ISA" : "the widest registers of this processor"};
}

// The reader has checked every key and range against the same table.
ParameterValues complete_values(const ModelInfo& model, const MaterialDescription& material) {
  ParameterValues values;
  for (const Parameter& parameter : model.parameters) {
    const auto given = material.parameters.find(std::string(parameter.name));
    values[std::string(parameter.name)] =
        given == material.parameters.end() ? parameter.default_value : std::get<double>(given->second.value);
  }
  return values;
}

RigidMotion motion(const std::vector<KeyFrame>& frames) {
  std::vector<RigidMotion::Key> keys;
  for (const KeyFrame& f : frames)
    keys.push_back({f.time, f.position, f.rotation * (std::numbers::pi / 180)});
  return RigidMotion(std::move(keys));
}

// Rounding of positions must stay far below a cell, or weights and gradients are noise.
constexpr double kRoundingPerCell = 1e-3;

void check_distance_from_origin(const SimulationDescription& s, const BodyDescription& body,
                                const Shape& shape, Problems& problems) {
  const Bounds b = along_axes(shape.bounds(), s.dimension);
  const double far = b.min.cwiseAbs().cwiseMax(b.max.cwiseAbs()).maxCoeff();
  if (far >= s.cell_size * (kMaxCell - 2 * kBlockEdge)) {
    problems.add(
        body.mark, fmt::format("bodies.{}", body.name),
        fmt::format(
            "reaches {:g} m from the origin, which is more than {} cells of {:g} m; move the scene to "
            "the origin or use a larger simulation.cell_size",
            far, kMaxCell - 2 * kBlockEdge, s.cell_size));
    return;
  }
  const double epsilon = s.precision == Precision::single ? 0x1p-23 : 0x1p-52;
  if (far * epsilon > kRoundingPerCell * s.cell_size)
    problems.add(
        body.mark, fmt::format("bodies.{}", body.name),
        fmt::format("reaches {:g} m from the origin, where numbers of this precision are {:.2g} m apart: too "
                    "coarse for cells of {:g} m; move the scene to the origin or set simulation.precision = "
                    "\"double\"",
                    far, far * epsilon, s.cell_size));
}

void plan_batches(const SceneDescription& scene, Plan& plan) {
  for (const MaterialDescription& material : scene.materials) {
    const ModelInfo& model = *find_model(material.model.text);
    Material law = make_material(material);
    const double density = std::visit([](const auto& m) { return m.density; }, law);
    ColumnSet columns = transfer_columns(scene.simulation.transfer) | model.columns;
    // The vectorised path uses the stress where it is computed; a column is for those who ask for one.
    const bool stress_asked =
        std::any_of(scene.output.attributes.begin(), scene.output.attributes.end(),
                    [](const Name& a) { return a.text == "stress" || a.text == "pressure"; });
    if (plan.path.isa && !stress_asked) columns = columns.without(Column::stress);
    if (scene.names_forces()) columns = columns | ColumnSet{Column::force};
    plan.batches.push_back({material.name, std::string(model.name), density, law, columns});
  }
}

void plan_bodies(const SceneDescription& scene, Plan& plan, Problems& problems) {
  const auto folder = scene.file.parent_path();
  for (const BodyDescription& body : scene.bodies) {
    BodyPlan out;
    if (body.shape) {
      out.shape = build_shape(*body.shape, folder, scene.simulation.cell_size / 2, plan.warnings, problems,
                              fmt::format("bodies.{}.shape", body.name));
      if (out.shape) check_distance_from_origin(scene.simulation, body, *out.shape, problems);
    }
    const auto named = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const auto& m) { return m.name == body.material.text; });
    out.batch = static_cast<std::size_t>(named - scene.materials.begin());
    plan.bodies.push_back(out);
  }
}

void plan_effects(const SceneDescription& scene, Plan& plan, Problems& problems) {
  if (scene.gravity) plan.effects.gravity = Gravity{*scene.gravity};
  for (const ColliderDescription& c : scene.colliders) {
    // Half a cell is what a node can tell apart.
    ShapePtr shape = build_shape(c.shape, scene.file.parent_path(), scene.simulation.cell_size / 2,
                                 plan.warnings, problems);
    plan.effects.colliders.push_back({c.name, shape, c.contact, c.friction, motion(c.keyframes)});
  }
  if (scene.body_force) plan.forces.acceleration.emplace(scene.body_force->acceleration, kForceNames);
  for (const LoadDescription& load : scene.loads)
    plan.forces.loads.push_back(
        {load.name,
         build_shape(load.region, scene.file.parent_path(), scene.simulation.cell_size / 2, plan.warnings,
                     problems, fmt::format("loads.{}.region", load.name)),
         VectorFormula(load.force, kForceNames)});
  if (scene.domain)
    plan.effects.domain =
        DomainWalls{scene.domain->min, scene.domain->max, scene.domain->contact, scene.domain->friction};
}

void plan_attributes(const SceneDescription& scene, Plan& plan, Problems& problems) {
  for (const Name& name : scene.output.attributes) {
    const auto* attribute = std::find_if(kAttributes.begin(), kAttributes.end(),
                                         [&](const Attribute& a) { return a.name == name.text; });
    const bool stored =
        !attribute->needs || std::any_of(plan.batches.begin(), plan.batches.end(),
                                         [&](const auto& b) { return b.columns.has(*attribute->needs); });
    if (!stored)
      problems.add(name.mark, "output.attributes",
                   fmt::format("'{}' does not exist here: {}", name.text, attribute->why_absent));
    plan.attributes.push_back(attribute);
  }
}

}  // namespace

Material make_material(const MaterialDescription& description) {
  const ModelInfo& model = *find_model(description.model.text);
  return make_material(model.name, complete_values(model, description));
}

int Plan::frames() const {
  // A duration that is a whole number of frames but for rounding keeps its last one.
  return 1 + static_cast<int>(std::floor(scene.simulation.duration * scene.simulation.frame_rate + 1e-9));
}

Plan make_plan(SceneDescription scene) {
  Plan plan;
  Problems problems;
  plan.path = plan_path(scene);
  plan_batches(scene, plan);
  plan_bodies(scene, plan, problems);
  plan_effects(scene, plan, problems);
  plan_attributes(scene, plan, problems);
  problems.throw_if_any();
  plan.scene = std::move(scene);
  if (plan.frames() == 1)
    plan.warnings.push_back(
        fmt::format("simulation.duration ({:g} s) is shorter than a frame ({:g} s): only the "
                    "start is written; raise it or simulation.frame_rate",
                    plan.scene.simulation.duration, 1 / plan.scene.simulation.frame_rate));
  return plan;
}

}  // namespace firn
