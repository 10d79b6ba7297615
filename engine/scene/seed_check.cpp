#include "engine/scene/seed_check.h"

#include <algorithm>

#include <fmt/format.h>

namespace firn {
namespace {

std::size_t count_inside(const Collider& collider, const std::vector<Vec3>& points) {
  const RigidPose pose = collider.motion.at(0);
  std::vector<Vec3> local(points.size());
  std::vector<double> phi(points.size());
  std::transform(points.begin(), points.end(), local.begin(),
                 [&](const Vec3& x) { return pose.to_local(x); });
  collider.shape->distance(local, phi);
  return static_cast<std::size_t>(std::count_if(phi.begin(), phi.end(), [](double d) { return d < 0; }));
}

std::size_t count_outside(const DomainWalls& domain, int dimension, const std::vector<Vec3>& points) {
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(), [&](const Vec3& x) {
    for (int d = 0; d < dimension; ++d)
      if (x[d] < domain.min[d] || x[d] > domain.max[d]) return true;
    return false;
  }));
}

/// A load on nothing would be missed only by who looks for what it does.
void check_loads(const Plan& plan, std::span<const Seeds> seeds) {
  Problems problems;
  for (std::size_t l = 0; l < plan.forces.loads.size(); ++l) {
    const auto loaded = [&](const Seeds& body) {
      const std::vector<bool> in = inside(*plan.forces.loads[l].region, body.position);
      return std::find(in.begin(), in.end(), true) != in.end();
    };
    if (std::any_of(seeds.begin(), seeds.end(), loaded)) continue;
    problems.add(plan.scene.loads[l].region.mark, fmt::format("loads.{}.region", plan.forces.loads[l].name),
                 "no particle starts in it; allowed: a region with one or more");
  }
  problems.throw_if_any();
}

}  // namespace

std::vector<std::string> check_seeds(const Plan& plan, std::span<const Seeds> seeds) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t body, std::size_t count, const std::string& where) {
    if (count == 0) return;
    const std::size_t all = seeds[body].position.size();
    warnings.push_back(fmt::format("body '{}' starts with {} of its {} particles ({:.2g} %) {}",
                                   plan.scene.bodies[body].name, count, all,
                                   100.0 * static_cast<double>(count) / static_cast<double>(all), where));
  };
  for (std::size_t b = 0; b < seeds.size(); ++b) {
    for (const Collider& collider : plan.effects.colliders)
      warn(b, count_inside(collider, seeds[b].position), fmt::format("inside collider '{}'", collider.name));
    if (plan.effects.domain)
      warn(b, count_outside(*plan.effects.domain, plan.dimension(), seeds[b].position), "outside the domain");
  }
  return warnings;
}

std::vector<Seeds> seed_bodies(const Plan& plan, std::vector<std::string>& warnings) {
  std::vector<Seeds> seeds;
  const SimulationDescription& s = plan.scene.simulation;
  for (std::size_t b = 0; b < plan.bodies.size(); ++b)
    seeds.push_back(seed_body(plan.scene.bodies[b], plan.bodies[b].shape.get(), s.dimension, s.cell_size,
                              s.seed, b, plan.scene.file.parent_path(), warnings));
  check_loads(plan, seeds);
  for (std::string& warning : check_seeds(plan, seeds)) warnings.push_back(std::move(warning));
  return seeds;
}

}  // namespace firn
