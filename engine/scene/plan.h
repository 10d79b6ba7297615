// A scene resolved: every name looked up, every shape built, every column and effect known. Immutable from
// here on; a user's mistake can only arise left of it.
#pragma once

#include <string>
#include <vector>

#include "engine/effects/grid_effects.h"
#include "engine/effects/particle_forces.h"
#include "engine/scene/attributes.h"
#include "engine/scene/description.h"
#include "engine/vector/isa.h"
#include "materials/registry.h"

namespace firn {

/// One body, ready to be seeded; the description with the same index says how.
struct BodyPlan {
  ShapePtr shape;  // null when the particles come from a file
  std::size_t batch;
};

/// All particles of one material.
struct BatchPlan {
  std::string material;  // its name in the scene
  std::string model;
  double density;  // kg/m^3
  Material law;
  ColumnSet columns;
};

/// How the scene is stepped, and why so.
struct PathPlan {
  std::optional<Isa> isa;  // of the vectorised path; empty: the plain one
  std::string reason;
};

struct Plan {
  SceneDescription scene;
  std::vector<BatchPlan> batches;
  std::vector<BodyPlan> bodies;
  GridEffects effects;
  ForceEffects forces;
  PathPlan path;
  std::vector<const Attribute*> attributes;  // beside P v id pscale
  std::vector<std::string> warnings;

  int dimension() const { return scene.simulation.dimension; }
  double cell_size() const { return scene.simulation.cell_size; }
  int frames() const;  // the first one included
};

/// Nodes lighter than so many particles are ignored. The linear kernel with USL needs it: as a particle
/// enters a cell, the far nodes have next to no mass and an acceleration without bound, which USL puts into
/// the strain. It takes the momentum on those nodes with it, and from 5e-2 on a noticeable part of the
/// energy.
inline double mass_cutoff(const SimulationDescription& s) {
  const bool needed = s.kernel == KernelName::linear && s.stress_order == StressOrder::usl;
  return s.mass_cutoff.value_or(needed ? 1e-4 : 0);
}

/// The model of a description that the reader has checked.
Material make_material(const MaterialDescription& description);

/// Throws Error{input} with all problems found.
Plan make_plan(SceneDescription scene);

}  // namespace firn
