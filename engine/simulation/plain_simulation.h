// The plain step: the reference that the vectorised path must agree with.
#pragma once

#include "engine/passes/g2p.h"
#include "engine/passes/grid_update.h"
#include "engine/passes/material_pass.h"
#include "engine/passes/p2g.h"
#include "engine/passes/sort.h"
#include "engine/simulation/particle_simulation.h"

namespace firn {

template <class Real, int D, class Kernel, class Transfer>
class PlainSimulation final : public ParticleSimulation<Real, D> {
  using Base = ParticleSimulation<Real, D>;
  using Base::batches_, Base::layout_, Base::plan_, Base::time_, Base::drift_, Base::timed;

 public:
  PlainSimulation(const Plan& plan, std::span<const Seeds> seeds) : Base(plan, seeds, inertia()) {
    if (plan.forces.any()) forces_.emplace(plan.forces, starts(seeds), this->masses_by_id());
    least_mass_ = static_cast<Real>(mass_cutoff(plan.scene.simulation) * this->lightest());
    run_materials(0);
  }

  void step(double dt, double) override {
    if (drift_ >= Kernel::farthest_drift * plan_->cell_size()) {
      timed(PassTimes::sort,
            [&] { sorter_.sort(batches_, cell_size(), layout_, ColumnSet::all().without(Column::force)); });
      drift_ = 0;
      ++this->sorts_;
    }
    effects_at<Real, D>(plan_->effects, time_ + dt, {}, effects_);
    Motion motion;
    switch (plan_->scene.simulation.stress_order) {
      case StressOrder::usl:
        update_forces(time_);
        project(dt);
        gather<kGatherAll>(dt, motion);
        break;
      case StressOrder::usf:
        project(0);
        gather<Gathered{.deformation = true}>(dt, motion);
        run_materials(dt);
        update_forces(time_ + dt);  // of the deformation that the stress belongs to
        project(dt);
        gather<Gathered{.velocity = true, .position = true}>(dt, motion);
        break;
      case StressOrder::musl:
        update_forces(time_);
        project(dt);
        gather<Gathered{.velocity = true}>(dt, motion);
        std::swap(grid_, moved_);
        project(0);
        gather<Gathered{.deformation = true}>(dt, motion);
        std::swap(grid_, moved_);
        gather<Gathered{.position = true}>(dt, motion);
        break;
    }
    time_ += dt;
    this->take(motion);
    if (plan_->scene.simulation.stress_order != StressOrder::usf) run_materials(dt);
    this->count_step(dt);
  }
  void shorten(double) override {}  // each step puts its own forces on the grid

  /// Effects of the grid are part of "grid".
  std::vector<Cost> costs() const override {
    std::vector<Cost> out = Base::common_costs(sorter_.bytes());
    out.push_back({"transfer",
                   {},
                   "p2g, g2p",
                   this->seconds(PassTimes::p2g) + this->seconds(PassTimes::g2p) - force_seconds_,
                   Base::column_bytes({Column::velocity, Column::affine})});
    out.push_back({"grid", {}, "grid", this->seconds(PassTimes::grid), grid_bytes() + layout_.bytes()});
    if (forces_)
      out.push_back(
          {"forces", {}, "p2g", force_seconds_, forces_->bytes() + Base::column_bytes({Column::force})});
    Base::add_materials(material_seconds_, "material", out);
    return out;
  }

  std::size_t bytes() const override {
    return this->table_bytes() + grid_bytes() + layout_.bytes() + sorter_.bytes() +
           (forces_ ? forces_->bytes() : 0);
  }

 private:
  static constexpr double inertia() {
    if constexpr (Kernel::affine) return Kernel::inverse_inertia;
    return 1;  // no affine velocity, so nobody asks
  }
  std::size_t grid_bytes() const {
    return grid_.nodes.bytes() + grid_.before.bytes() + moved_.nodes.bytes() + moved_.before.bytes();
  }
  Real cell_size() const { return static_cast<Real>(plan_->cell_size()); }

  static std::vector<Vec3> starts(std::span<const Seeds> seeds) {
    std::vector<Vec3> out;
    for (const Seeds& body : seeds) out.insert(out.end(), body.position.begin(), body.position.end());
    return out;
  }

  void update_forces(double time) {
    if (!forces_) return;
    const double before = this->seconds(PassTimes::p2g);
    timed(PassTimes::p2g, [&] {
      for (auto& batch : batches_) forces_->update(batch.particles, time);
    });
    force_seconds_ += this->seconds(PassTimes::p2g) - before;
  }

  /// The particles' momentum on the grid, and on top of it the forces and effects of `dt`.
  void project(double dt) {
    timed(PassTimes::p2g, [&] {
      p2g<Kernel, Transfer, Real, D>(std::span<const Batch<Real, D>>(batches_), layout_, cell_size(),
                                     static_cast<Real>(dt), grid_);
    });
    timed(PassTimes::grid, [&] {
      const std::span<const StepEffect<Real, D>> effects = effects_;
      this->ignored_nodes_ +=
          grid_update<Transfer, Real, D>(layout_, plan_->cell_size(), dt, effects, least_mass_, grid_);
    });
  }

  template <Gathered what>
  void gather(double dt, Motion& motion) {
    timed(PassTimes::g2p, [&] {
      const Real ratio = static_cast<Real>(plan_->scene.simulation.flip_ratio.value_or(kDefaultFlipRatio));
      const Motion m = g2p<Kernel, Transfer, Real, D, what>(batches_, layout_, cell_size(),
                                                            static_cast<Real>(dt), ratio, grid_);
      motion.max_speed = std::max(motion.max_speed, m.max_speed);
      motion.max_displacement = std::max(motion.max_displacement, m.max_displacement);
      motion.invalid = std::max(motion.invalid, m.invalid);  // of the same particles
    });
  }

  void run_materials(double dt) {
    timed(PassTimes::material, [&] { update_materials(static_cast<Real>(dt)); });
  }
  void update_materials(Real dt) {
    reports_.clear();
    material_seconds_.resize(batches_.size());
    for (std::size_t b = 0; b < batches_.size(); ++b) {
      const auto start = std::chrono::steady_clock::now();
      reports_.push_back(
          std::visit([&](const auto& model) { return material_pass(model, batches_[b].particles, dt); },
                     plan_->batches[b].law));
      material_seconds_[b] += Base::seconds_since(start);
    }
    this->take(reports_);
  }

  Sorter<Kernel, Real, D> sorter_;
  GridNodes<Real, D> grid_;
  GridNodes<Real, D> moved_;  // MUSL: what moves the particles, while grid_ has their new velocities
  std::optional<ParticleForces> forces_;
  double force_seconds_ = 0;
  Real least_mass_;  // kg; lighter nodes are ignored
  std::vector<StepEffect<Real, D>> effects_;
  std::vector<MaterialReport> reports_;
  std::vector<double> material_seconds_;  // by batch
};

}  // namespace firn
