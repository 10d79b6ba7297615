// What every way of stepping has in common: the particles, the clock, and how they are looked at.
#pragma once

#include <chrono>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/passes/totals.h"
#include "engine/simulation/attribute_views.h"
#include "engine/simulation/copy_points.h"
#include "engine/simulation/seed_batches.h"
#include "engine/simulation/simulation.h"

namespace firn {

template <class Real, int D>
class ParticleSimulation : public Simulation {
 public:
  double stable_dt() const override {
    const SimulationDescription& s = plan_->scene.simulation;
    const double dt = s.cfl * s.cell_size / (std::max(max_speed_, collider_speed_) + wave_speed_);
    return std::min(dt, s.max_dt.value_or(dt));
  }

  double time() const override { return time_; }
  void set_time(double time) override { time_ = time; }

  FrameView view() override {
    const auto start = std::chrono::steady_clock::now();
    FrameView out;
    out.time = time_;
    out.particles = count_;
    out.steps = std::exchange(steps_, {});
    out.counters = {{kCounters[0], std::exchange(capped_, 0)},
                    {kCounters[1], std::exchange(ignored_nodes_, 0)}};
    out.totals = all_totals();
    const std::span<const Batch<Real, D>> batches = batches_;
    out.copy_id = [batches](std::size_t first, std::span<std::int64_t> ids) {
      detail::for_particles<Real, D>(
          batches, first, ids.size(),
          [&](std::size_t b, std::size_t p, std::size_t k) { ids[k] = batches[b].particles.id()[p]; });
    };
    out.attributes = {attribute_view<Real, D>(batches, "P", 3), attribute_view<Real, D>(batches, "v", 3),
                      attribute_view<Real, D>(batches, "pscale", 1)};
    for (const Attribute* a : plan_->attributes)
      out.attributes.push_back(attribute_view<Real, D>(batches, a->name, a->components));
    frame_seconds_ += seconds_since(start);
    return out;
  }

  MaterialPoints material_points() const override {
    MaterialPoints out(count_);
    for (std::size_t b = 0; b < batches_.size(); ++b)
      std::visit([&](const auto& model) { copy_points<D>(model, batches_[b].particles, out); },
                 plan_->batches[b].law);
    return out;
  }

  std::size_t particles() const override { return count_; }
  std::size_t sorts() const override { return sorts_; }
  std::size_t blocks() const override { return layout_.size(); }
  std::size_t occupied_blocks() const override { return layout_.occupied(); }
  const PassTimes& times() const override { return times_; }

 protected:
  /// `inverse_inertia`: h^2 D_p^-1 of the kernel.
  ParticleSimulation(const Plan& plan, std::span<const Seeds> seeds, double inverse_inertia)
      : plan_(&plan), batches_(seed_batches<Real, D>(plan, seeds)), inverse_inertia_(inverse_inertia) {
    for (std::size_t b = 0; b < batches_.size(); ++b) count_ += batches_[b].particles.size();
    for (std::size_t b = 0; b < seeds.size(); ++b)
      max_speed_ = std::max(max_speed_, fastest(batches_[plan.bodies[b].batch]));
    for (const Collider& collider : plan.effects.colliders)
      collider_speed_ = std::max(collider_speed_, collider.motion.max_speed(reach(*collider.shape)));
  }

  template <class F>
  void timed(PassTimes::Pass pass, F&& f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    times_.seconds[pass] += seconds_since(start);
  }
  /// What was done to set up is not part of any step.
  void restart_clock() { times_ = {}; }
  static double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  double seconds(PassTimes::Pass pass) const { return times_.seconds[pass]; }

  /// What both paths have: particles, sorting, frames. `sort_bytes`: what the sorter holds.
  std::vector<Cost> common_costs(std::size_t sort_bytes) const {
    return {{"particles",
             {},
             {},
             0,
             column_bytes({Column::position, Column::mass, Column::volume}) + count_ * sizeof(std::uint32_t)},
            {"sort", {}, "sort", seconds(PassTimes::sort), sort_bytes},
            {"frame totals", {}, "frame", frame_seconds_, 0}};
  }
  std::size_t column_bytes(ColumnSet columns) const {
    std::size_t sum = 0;
    for (const auto& batch : batches_) sum += column_bytes(batch, columns);
    return sum;
  }
  static std::size_t column_bytes(const Batch<Real, D>& batch, ColumnSet columns) {
    return batch.particles.size() * sizeof(Real) *
           static_cast<std::size_t>((batch.particles.columns() & columns).reals(D));
  }
  /// What the materials of the particles take; `material` seconds each.
  void add_materials(std::span<const double> material, std::string_view passes,
                     std::vector<Cost>& out) const {
    for (std::size_t b = 0; b < batches_.size(); ++b)
      out.push_back({plan_->batches[b].material, "material", passes, material[b],
                     column_bytes(batches_[b], kMaterialState | ColumnSet{Column::stress})});
  }

  /// Takes over what the materials of a step answered, one report per batch.
  void take(std::span<const MaterialReport> reports) {
    wave_speed_ = 0;
    for (std::size_t b = 0; b < reports.size(); ++b) {
      if (reports[b].invalid > 0) stop("the stress of particles is no longer finite", reports[b].invalid);
      wave_speed_ = std::max(wave_speed_, std::sqrt(reports[b].max_wave_modulus / plan_->batches[b].density));
      dissipated_ += reports[b].dissipated;
      capped_ += reports[b].capped;
    }
  }
  void take(const Motion& motion) {
    if (motion.invalid > 0)
      stop("the state of particles is no longer finite or left the grid's reach", motion.invalid);
    max_speed_ = motion.max_speed;
    drift_ += motion.max_displacement;
  }
  void count_step(double dt) {
    ++steps_.steps;
    steps_.dt_min = steps_.steps == 1 ? dt : std::min(steps_.dt_min, dt);
    steps_.dt_max = std::max(steps_.dt_max, dt);
  }
  /// kg
  std::vector<double> masses_by_id() const {
    std::vector<double> out(count_);
    for (const auto& batch : batches_)
      for (std::size_t p = 0; p < batch.particles.size(); ++p)
        out[batch.particles.id()[p]] =
            static_cast<double>(batch.particles.template view<Column::mass>().load(p));
    return out;
  }
  /// Mass of the lightest particle, kg.
  double lightest() const {
    Real m = std::numeric_limits<Real>::max();
    for (const auto& batch : batches_)
      for (std::size_t p = 0; p < batch.particles.size(); ++p)
        m = std::min(m, batch.particles.template view<Column::mass>().load(p));
    return static_cast<double>(m);
  }
  std::size_t table_bytes() const {
    std::size_t sum = 0;
    for (const auto& batch : batches_)
      sum += batch.particles.size() * ParticleTable<Real, D>::bytes_per_particle(batch.particles.columns());
    return sum;
  }

  [[noreturn]] void stop(std::string_view what, std::int64_t count) const {
    throw Error(
        ExitCode::numerics,
        fmt::format(
            "t = {:.6g} s: {} ({} of {}); {}. Frames before it are whole. A smaller simulation.cfl, or "
            "simulation.precision = \"double\" if the numbers are large, may help.",
            time_, what, count, count_, first_invalid()));
  }

  const Plan* plan_;
  std::vector<Batch<Real, D>> batches_;
  BlockLayout<D> layout_;
  std::size_t count_ = 0, sorts_ = 0;
  double time_ = 0;
  double drift_ = std::numeric_limits<double>::infinity();  // m since the last sort; nothing is sorted yet
  double max_speed_ = 0, collider_speed_ = 0, wave_speed_ = 0;
  double dissipated_ = 0;
  std::int64_t capped_ = 0, ignored_nodes_ = 0;

 private:
  static double fastest(const Batch<Real, D>& batch) {
    const auto velocity = batch.particles.template view<Column::velocity>();
    double speed = 0;
    for (std::size_t p = 0; p < batch.particles.size(); ++p)
      speed = std::max(speed, static_cast<double>(norm(velocity.load(p))));
    return speed;
  }

  /// The farthest point of a shape from its own origin; what has no end does not turn.
  static double reach(const Shape& shape) {
    const Bounds b = along_axes(shape.bounds(), D);
    const double r = b.min.cwiseAbs().cwiseMax(b.max.cwiseAbs()).norm();
    return std::isfinite(r) ? r : 0;
  }

  FrameTotals all_totals() const {
    FrameTotals sum;
    sum.min_J = std::numeric_limits<double>::infinity();
    sum.max_J = -sum.min_J;
    auto g = Vector<double, 3>::zero();
    if (plan_->effects.gravity)
      for (int d = 0; d < 3; ++d) g[d] = plan_->effects.gravity->acceleration[d];
    for (std::size_t b = 0; b < batches_.size(); ++b)
      std::visit(
          [&](const auto& model) {
            join(sum, totals(model, batches_[b].particles, plan_->cell_size(), inverse_inertia_, g));
          },
          plan_->batches[b].law);
    sum.dissipated = dissipated_;
    return sum;
  }

  std::string first_invalid() const {
    for (std::size_t b = 0; b < batches_.size(); ++b) {
      const auto& t = batches_[b].particles;
      for (std::size_t p = 0; p < t.size(); ++p) {
        const Vector<Real, D> x = t.template view<Column::position>().load(p);
        const Vector<Real, D> v = t.template view<Column::velocity>().load(p);
        const Matrix<Real, D> F = t.template view<Column::elastic_deformation>().load(p);
        Real sum = dot(x, x) + dot(v, v) + frobenius2(F);
        if (t.columns().has(Column::stress)) sum += frobenius2(t.template view<Column::stress>().load(p));
        const bool in_reach = norm(x) < static_cast<Real>(plan_->cell_size() * (kMaxCell - 2 * kBlockEdge));
        if (std::isfinite(sum) && in_reach) continue;
        return fmt::format("particle {} of material '{}': x = {}, v = {}, F_E = {}", t.id()[p],
                           plan_->batches[b].material, text(&x[0], D), text(&v[0], D),
                           text(&F.m[0][0], D * D));
      }
    }
    return "in a value that is not stored";
  }

  static std::string text(const Real* values, int n) {
    std::string out = "(";
    for (int i = 0; i < n; ++i) out += fmt::format("{}{:.6g}", i > 0 ? ", " : "", values[i]);
    return out + ")";
  }

  FrameSteps steps_;
  PassTimes times_;
  double frame_seconds_ = 0;
  double inverse_inertia_;
};

}  // namespace firn
