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
  PlainSimulation(const Plan& plan, std::span<const Seeds> seeds) : Base(plan, seeds) { run_materials(0); }

  void step(double dt, double) override {
    const double h = plan_->cell_size();
    const Real dt_real = static_cast<Real>(dt), h_real = static_cast<Real>(h);
    const std::span<Batch<Real, D>> batches = batches_;
    if (drift_ >= Base::kFarthestDrift * h) {
      timed(PassTimes::sort, [&] { sorter_.sort(batches, h_real, layout_, ColumnSet::all()); });
      drift_ = 0;
      ++this->sorts_;
    }
    timed(PassTimes::p2g, [&] {
      p2g<Kernel, Transfer, Real, D>(std::span<const Batch<Real, D>>(batches), layout_, h_real, dt_real,
                                     grid_);
    });
    timed(PassTimes::grid, [&] {
      effects_at<Real, D>(plan_->effects, time_ + dt, {}, effects_);
      grid_update<Transfer, Real, D>(layout_, h, dt, effects_, grid_);
    });
    Motion motion;
    timed(PassTimes::g2p, [&] {
      const Real ratio = static_cast<Real>(plan_->scene.simulation.flip_ratio.value_or(kDefaultFlipRatio));
      motion = g2p<Kernel, Transfer, Real, D>(batches, layout_, h_real, dt_real, ratio, grid_);
    });
    time_ += dt;
    this->take(motion);
    timed(PassTimes::material, [&] { run_materials(dt_real); });
    this->count_step(dt);
  }
  void shorten(double) override {}  // each step puts its own forces on the grid

  /// Effects of the grid are part of "grid".
  std::vector<Cost> costs() const override {
    std::vector<Cost> out = Base::common_costs(sorter_.bytes());
    out.push_back({"transfer",
                   {},
                   "p2g, g2p",
                   this->seconds(PassTimes::p2g) + this->seconds(PassTimes::g2p),
                   Base::column_bytes({Column::velocity, Column::affine})});
    out.push_back({"grid",
                   {},
                   "grid",
                   this->seconds(PassTimes::grid),
                   grid_.nodes.bytes() + grid_.before.bytes() + layout_.bytes()});
    Base::add_materials(material_seconds_, "material", out);
    return out;
  }

  std::size_t bytes() const override {
    return this->table_bytes() + grid_.nodes.bytes() + grid_.before.bytes() + layout_.bytes() +
           sorter_.bytes();
  }

 private:
  void run_materials(Real dt) {
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
  std::vector<StepEffect<Real, D>> effects_;
  std::vector<MaterialReport> reports_;
  std::vector<double> material_seconds_;  // by batch
};

}  // namespace firn
