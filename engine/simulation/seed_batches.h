// Seeds to particle tables: every column of the plan filled with the state at rest.
#pragma once

#include <numbers>

#include "engine/passes/batch.h"
#include "engine/scene/plan.h"
#include "engine/scene/seeding.h"

namespace firn {

/// One batch per material of the plan; ids count through the bodies in the order of the scene.
template <class Real, int D>
std::vector<Batch<Real, D>> seed_batches(const Plan& plan, std::span<const Seeds> seeds) {
  std::vector<std::size_t> sizes(plan.batches.size());
  for (std::size_t b = 0; b < seeds.size(); ++b) sizes[plan.bodies[b].batch] += seeds[b].position.size();
  std::vector<Batch<Real, D>> batches;
  for (std::size_t b = 0; b < sizes.size(); ++b)
    batches.push_back({ParticleTable<Real, D>(plan.batches[b].columns, sizes[b]), {}});

  std::vector<std::size_t> next(batches.size());
  std::uint32_t id = 0;
  for (std::size_t b = 0; b < seeds.size(); ++b) {
    const Seeds& body = seeds[b];
    const BodyDescription& description = plan.scene.bodies[b];
    const std::size_t batch = plan.bodies[b].batch;
    auto& table = batches[batch].particles;
    const double volume = body.volume / static_cast<double>(body.position.size());
    const Vec3 spin = description.angular_velocity * (std::numbers::pi / 180);
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : body.position) centre += x / static_cast<double>(body.position.size());
    const auto F_one = Matrix<Real, D>::identity();
    for (std::size_t k = 0; k < body.position.size(); ++k, ++id) {
      const std::size_t p = next[batch]++;
      const Vec3& x = body.position[k];
      Vec3 v = description.velocity + spin.cross(x - centre);
      if (!body.velocity.empty()) v += body.velocity[k];
      table.template view<Column::position>().store(p, to_vector<Real, D>(x));
      table.template view<Column::velocity>().store(p, to_vector<Real, D>(v));
      table.template view<Column::volume>().store(p, static_cast<Real>(volume));
      table.template view<Column::mass>().store(p, static_cast<Real>(volume * plan.batches[batch].density));
      table.template view<Column::elastic_deformation>().store(p, F_one);
      if (table.columns().has(Column::plastic_deformation))
        table.template view<Column::plastic_deformation>().store(p, F_one);
      if (table.columns().has(Column::affine)) {
        // A rigid spin is an affine velocity: C is its matrix, so that no angular momentum is missing at t =
        // 0.
        Matrix<Real, D> C;
        for (int j = 0; j < D; ++j) {
          const Vec3 column = spin.cross(Vec3::Unit(j));
          for (int i = 0; i < D; ++i) C(i, j) = static_cast<Real>(column[i]);
        }
        table.template view<Column::affine>().store(p, C);
      }
      table.id()[p] = id;
    }
  }
  return batches;
}

}  // namespace firn
