// Seeds to particle tables: every column of the plan filled with the state at rest.
#pragma once

#include <numbers>

#include "engine/passes/batch.h"
#include "engine/scene/plan.h"
#include "engine/scene/seeding.h"

namespace firn {

/// The velocity (m/s, places in m) that a body's description gives its particles: `velocity` and the spin
/// about the centre.
class StartVelocity {
 public:
  StartVelocity(const BodyDescription& body, const Seeds& seeds, double cell_size)
      : velocity_(body.velocity, kPlaceNames),
        spin_(body.angular_velocity * (std::numbers::pi / 180)),
        step_(1e-5 * cell_size) {
    for (const Vec3& x : seeds.position) centre_ += x / static_cast<double>(seeds.position.size());
  }

  Vec3 at(const Vec3& x) const { return formula(x) + spin_.cross(x - centre_); }
  /// dv/dx_axis. A spin, and what the formula says, are affine velocities near a particle: with their
  /// gradient in C, APIC lacks no momentum at t = 0.
  Vec3 derivative(const Vec3& x, int axis) const {
    Vec3 out = spin_.cross(Vec3::Unit(axis));
    if (velocity_.constant()) return out;
    // Second-order: 1e-10 of a velocity that varies over a cell, beside the rounding of its values.
    const Vec3 aside = step_ * Vec3::Unit(axis);
    return out + (formula(x + aside) - formula(x - aside)) / (2 * step_);
  }

 private:
  Vec3 formula(const Vec3& x) const {
    const auto v = velocity_({x.data(), 3});
    return {v[0], v[1], v[2]};
  }

  VectorFormula velocity_;
  Vec3 spin_, centre_ = Vec3::Zero();
  double step_;  // m, of the differences
};

template <class Model, class Real, int D>
void store_at_rest(const Model& model, ParticleTable<Real, D>& table, std::size_t p) {
  auto point = model.template at_rest<Real, D>();
  point.visit([&](auto column, const auto& value) { table.template view<column()>().store(p, value); });
}

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
    const std::size_t batch = plan.bodies[b].batch;
    auto& table = batches[batch].particles;
    const double volume = body.volume / static_cast<double>(body.position.size());
    const StartVelocity start(plan.scene.bodies[b], body, plan.cell_size());
    for (std::size_t k = 0; k < body.position.size(); ++k, ++id) {
      const std::size_t p = next[batch]++;
      const Vec3& x = body.position[k];
      Vec3 v = start.at(x);
      if (!body.velocity.empty()) v += body.velocity[k];
      table.template view<Column::position>().store(p, to_vector<Real, D>(x));
      table.template view<Column::velocity>().store(p, to_vector<Real, D>(v));
      table.template view<Column::volume>().store(p, static_cast<Real>(volume));
      table.template view<Column::mass>().store(p, static_cast<Real>(volume * plan.batches[batch].density));
      std::visit([&](const auto& law) { store_at_rest(law, table, p); }, plan.batches[batch].law);
      if (table.columns().has(Column::affine)) {
        Matrix<Real, D> C;
        for (int j = 0; j < D; ++j) {
          const Vec3 column = start.derivative(x, j);
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
