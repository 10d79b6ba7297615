// A scene from text to a simulation that can be stepped, as a run does it.
#pragma once

#include <string>

#include "engine/scene/reader.h"
#include "engine/simulation/simulation.h"

namespace firn::test {

/// The plan's address must not change while the simulation lives.
struct Simulated {
  Plan plan;
  std::unique_ptr<Simulation> simulation;

  /// `change`: what to do with the seeds before anything is made of them.
  explicit Simulated(const std::string& toml, std::vector<std::string> overrides = {},
                     const std::filesystem::path& folder = FIRN_TEST_DATA,
                     const std::function<void(std::vector<Seeds>&)>& change = {})
      : plan(make_plan(read_scene_text(toml, folder / "scene.toml", overrides))) {
    std::vector<Seeds> seeds;
    const SimulationDescription& s = plan.scene.simulation;
    for (std::size_t b = 0; b < plan.bodies.size(); ++b)
      seeds.push_back(seed_body(plan.scene.bodies[b], plan.bodies[b].shape.get(), s.dimension, s.cell_size,
                                s.seed, b, plan.scene.file.parent_path(), plan.warnings));
    if (change) change(seeds);
    simulation = make_simulation(plan, seeds);
  }
  Simulated(const Simulated&) = delete;

  Simulation* operator->() { return simulation.get(); }
  FrameTotals totals() { return simulation->view().totals; }

  /// One attribute of all particles in the order of their ids.
  std::vector<float> attribute(const std::string& name) {
    const FrameView view = simulation->view();
    std::vector<std::int64_t> id(view.particles);
    view.copy_id(0, id);
    for (const AttributeView& a : view.attributes) {
      if (a.name != name) continue;
      const auto width = static_cast<std::size_t>(a.components);
      std::vector<float> values(view.particles * width), sorted(values.size());
      a.copy(0, values);
      for (std::size_t p = 0; p < id.size(); ++p)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(p * width), width,
                    sorted.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(id[p]) * width));
      return sorted;
    }
    throw std::logic_error("no attribute " + name);
  }
};

}  // namespace firn::test
