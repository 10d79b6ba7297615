// The production step: vectorised, two passes. The grid update adds up what the blocks of particles left for
// it; the particle pass takes velocities from the grid, moves the particles, returns them to what their
// material allows, and already leaves the next step's momentum and forces. Where the caller wants to look in
// between, at frames, the particle pass is split in two.
#pragma once

#include "engine/base/tick_clock.h"
#include "engine/passes/grid_update.h"
#include "engine/passes/outboxes.h"
#include "engine/passes/sort.h"
#include "engine/simulation/block_samples.h"
#include "engine/simulation/particle_simulation.h"
#include "engine/vector/kernel_tables.h"

namespace firn {

template <class Real, int D>
class VectorSimulation final : public ParticleSimulation<Real, D> {
  using Base = ParticleSimulation<Real, D>;
  using Base::batches_, Base::layout_, Base::plan_, Base::time_, Base::drift_, Base::timed;
  using Kernel = typename TransferKernels<Real, D>::Kernel;

 public:
  VectorSimulation(const Plan& plan, std::span<const Seeds> seeds, const KernelTable<Real, D>& table,
                   const SortKernels<Real>& sort_kernels)
      : Base(plan, seeds, QuadraticKernel::inverse_inertia),
        kernels_(transfer(table, plan.scene.simulation.transfer)),
        grid_kernels_(table.grid),
        updates_(table.materials),
        sorter_(sort_kernels),
        reports_(batches_.size()) {
    lightest_ = static_cast<Real>(this->lightest());
    for (const Collider& collider : plan.effects.colliders)
      if (collider.motion.still()) still_.emplace_back(collider);
    sort(ColumnSet::all());
    // The wave speed of the seeded state; what else it leaves is not used.
    run_blocks(PassTimes::p2g, kernels_.begin, 0, 0);
    take_reports();
    Base::restart_clock();
  }

  void step(double dt, double next) override {
    const double farthest = QuadraticKernel::farthest_drift * plan_->cell_size();
    FIRN_CHECK(announced_ == 0 || announced_ == dt);
    if (announced_ == 0) {
      if (drift_ >= farthest) timed(PassTimes::sort, [&] { sort(ColumnSet::all()); });
      run_blocks(PassTimes::p2g, kernels_.begin, 0, dt);
    }
    double reach = 0;  // m: no particle moves farther in this step
    timed(PassTimes::grid, [&] {
      find_contacts();
      effects_at<Real, D>(plan_->effects, time_ + dt, still_, effects_);
      reach = dt * update_grid(dt);
    });
    if (drift_ > 0 && !(drift_ + reach < farthest))
      timed(PassTimes::sort, [&] {
        // Between the grid update and the particle pass nobody needs v and C.
        sort(ColumnSet::all().without(Column::velocity).without(Column::affine).without(Column::stress));
        move_grid();
      });
    // Particles that may have left the block's scratch cannot be scattered before they are sorted again.
    announced_ = drift_ + reach < farthest ? next : 0;
    run_blocks(PassTimes::g2p, announced_ > 0 ? kernels_.fused : kernels_.finish, dt, announced_);
    time_ += dt;
    Motion motion;
    for (const Motion& m : motions_) motion.join(m);
    this->take(motion);
    take_reports();
    this->count_step(dt);
  }

  void shorten(double next) override {
    if (announced_ == 0) return;
    run_blocks(PassTimes::p2g, kernels_.adjust, 0, next - announced_);
    announced_ = next;
  }

  FrameView view() override {
    FIRN_CHECK(announced_ == 0);  // v and C of particles are not kept in a fused step
    return Base::view();
  }

  std::vector<Cost> costs() const override {
    std::vector<Cost> out = Base::common_costs(sorter_.bytes());
    double transfer = 0;
    std::vector<double> material(batches_.size());
    for (const PassTimes::Pass pass : {PassTimes::p2g, PassTimes::g2p}) {
      const std::vector<double> shares = samples_[pass].shares();
      for (std::size_t k = 0; k < shares.size(); ++k)
        (k % kTaskParts == kMaterialPart ? material[k / kTaskParts] : transfer) +=
            shares[k] * this->seconds(pass);
    }
    out.push_back({"transfer",
                   {},
                   "p2g, g2p",
                   transfer,
                   Base::column_bytes({Column::velocity, Column::affine}) + outboxes_.bytes()});
    Base::add_materials(material, "p2g, g2p", out);

    // The parts of the grid update: what every scene needs, then the effects in their order.
    const std::vector<double> shares = grid_samples_.shares();
    double shared = this->seconds(PassTimes::grid);
    for (const auto& collider : still_) shared -= collider.seconds();
    const auto grid = [&](std::size_t part) { return part < shares.size() ? shares[part] * shared : 0; };
    std::size_t part = 0;
    out.push_back({"grid",
                   {},
                   "grid",
                   grid(part++),
                   grid_.bytes() + other_grid_.bytes() + layout_.bytes() + old_layout_.bytes()});
    if (plan_->effects.gravity) out.push_back({"gravity", {}, "grid", grid(part++), 0});
    auto still = still_.begin();
    for (const Collider& c : plan_->effects.colliders) {
      out.push_back({c.name, "collider", "grid", grid(part++), 0});
      if (!c.motion.still()) continue;
      out.back().seconds += still->seconds();
      out.back().bytes += still->bytes();
      ++still;
    }
    if (plan_->effects.domain) out.push_back({"domain", {}, "grid", grid(part++), 0});
    return out;
  }

  std::size_t bytes() const override {
    std::size_t contact_bytes = 0;
    for (const auto& collider : still_) contact_bytes += collider.bytes();
    return this->table_bytes() + grid_.bytes() + other_grid_.bytes() + outboxes_.bytes() + layout_.bytes() +
           old_layout_.bytes() + sorter_.bytes() + contact_bytes;
  }

 private:
  static TransferKernels<Real, D> transfer(const KernelTable<Real, D>& table, Transfer transfer) {
    switch (transfer) {
      case Transfer::pic:
        return table.pic;
      case Transfer::mls:
        return table.mls;
      default:
        return table.apic;
    }
  }

  void sort(ColumnSet moved) {
    std::swap(layout_, old_layout_);
    sorter_.sort(batches_, static_cast<Real>(plan_->cell_size()), layout_, moved);
    drift_ = 0;
    ++this->sorts_;
    outboxes_.resize(layout_.occupied());
    lines_.assign(layout_.occupied(), kAllLines<D>);
    new_lines_.resize(layout_.occupied());
    motions_.resize(layout_.occupied());
    block_reports_.resize(layout_.occupied() * batches_.size());
    make_tasks();
    contacts_known_ = false;
  }

  void make_tasks() {
    const std::size_t n = batches_.size();
    tasks_.resize(layout_.occupied() * n);
    for (std::size_t k = 0; k < n; ++k) {
      const Material& law = plan_->batches[k].law;
      const void* model = std::visit([](const auto& m) { return static_cast<const void*>(&m); }, law);
      const ColumnPointers<Real> columns = batches_[k].particles.pointers();
      for (std::size_t b = 0; b < layout_.occupied(); ++b) {
        const auto [first, last] = batches_[k].range(b);
        tasks_[b * n + k] = {columns, first, last, updates_[law.index()], model, &block_reports_[b * n + k],
                             nullptr};
      }
    }
  }

  // The velocities of the blocks that both layouts have. A particle's nodes were all in use before the sort.
  void move_grid() {
    other_grid_.resize(layout_);
    tbb::parallel_for(std::size_t{0}, layout_.size(), [&](std::size_t b) {
      const std::uint32_t old = old_layout_.find(layout_.coord(b));
      const auto to = other_grid_.block(b);
      if (old == BlockLayout<D>::kNone)
        std::fill(to.begin(), to.end(), Node<Real, D>{});
      else
        std::copy(grid_.block(old).begin(), grid_.block(old).end(), to.begin());
    });
    grid_.swap(other_grid_);
  }

  void find_contacts() {
    if (contacts_known_) return;
    for (auto& collider : still_) collider.find(layout_, plan_->cell_size());
    contacts_known_ = true;
  }

  /// A bound on the velocity components of all particles in this step, m/s; not finite when a node's is not.
  double update_grid(double dt) {
    grid_.resize(layout_);
    grid_samples_.begin(layout_.size(), 1 + effects_.size());
    const SpeedBound all = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, layout_.size(), 4), SpeedBound{},
        [&](const tbb::blocked_range<std::size_t>& range, SpeedBound bound) {
          OutboxViews<Real, D> from, next = sources(range.begin());
          for (std::size_t b = range.begin(); b < range.end(); ++b) {
            from = next;
            next = sources(std::min(b + 1, layout_.size() - 1));
            bound.join(update_grid_block(b, from, next, dt));
          }
          return bound;
        },
        [](SpeedBound a, const SpeedBound& b) {
          a.join(b);
          return a;
        });
    grid_samples_.end();
    return all.value();
  }

  SpeedBound update_grid_block(std::size_t b, const OutboxViews<Real, D>& from,
                               const OutboxViews<Real, D>& next, double dt) {
    TickClock clock(grid_samples_.of(b));
    Real* const nodes = &grid_.block(b)[0].v[0];
    const bool used = grid_kernels_.collect(from, next, nodes);
    clock.lap(0);
    if (!used) return {};
    BlockNodes<Real, D> block{grid_.block(b), {}, layout_.coord(b), plan_->cell_size(), b};
    for (std::size_t e = 0; e < effects_.size(); ++e) {
      apply(effects_[e], block, dt);
      clock.lap(1 + e);
    }
    const SpeedBound bound = grid_kernels_.speed_bound(nodes, lightest_);
    clock.lap(0);
    return bound;
  }

  OutboxViews<Real, D> sources(std::size_t b) {
    OutboxViews<Real, D> out;
    std::transform(layout_.sources(b).begin(), layout_.sources(b).end(), out.begin(), [&](std::uint32_t s) {
      return s == BlockLayout<D>::kNone ? OutboxView<Real>{}
                                        : OutboxView<Real>{&outboxes_.block(s)->v[0], lines_[s]};
    });
    return out;
  }

  void run_blocks(PassTimes::Pass pass, Kernel kernel, double dt, double next) {
    samples_[pass].begin(layout_.occupied(), kTaskParts * batches_.size());
    timed(pass, [&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, layout_.occupied(), 1), [&](const auto& range) {
        for (std::size_t b = range.begin(); b < range.end(); ++b)
          run_block(kernel, b, dt, next, samples_[pass].of(b));
      });
    });
    samples_[pass].end();
    if (next != 0) std::swap(lines_, new_lines_);  // something was scattered
  }

  std::array<const Real*, kNeighbours<D>> velocities(std::size_t b) {
    std::array<const Real*, kNeighbours<D>> out;
    std::transform(layout_.neighbours(b).begin(), layout_.neighbours(b).end(), out.begin(),
                   [&](std::uint32_t n) { return &grid_.block(n)[0].v[0]; });
    return out;
  }

  void run_block(Kernel kernel, std::size_t b, double dt, double next, std::uint64_t* ticks) {
    const std::size_t first = b * batches_.size();
    for (std::size_t k = 0; k < batches_.size(); ++k) {
      block_reports_[first + k] = {};
      tasks_[first + k].ticks = ticks == nullptr ? nullptr : ticks + k * kTaskParts;
    }
    BlockTask<Real, D> task{};
    task.batches = {tasks_.data() + first, batches_.size()};
    task.block = layout_.coord(b);
    if (dt > 0) {
      task.velocities = velocities(b);
      const std::size_t next_block = std::min(b + 1, layout_.occupied() - 1);
      task.next_velocities = velocities(next_block);
      task.next_lines = lines_[next_block];
    }
    task.lines = lines_[b];
    task.outbox = &outboxes_.block(b)->v[0];
    task.h = static_cast<Real>(plan_->cell_size());
    task.dt = static_cast<Real>(dt);
    task.next = static_cast<Real>(next);
    kernel(task);
    new_lines_[b] = task.touched;
    motions_[b] = task.motion;
  }

  void take_reports() {
    std::fill(reports_.begin(), reports_.end(), MaterialReport{});
    for (std::size_t k = 0; k < block_reports_.size(); ++k)
      reports_[k % batches_.size()].join(block_reports_[k]);
    this->take(reports_);
  }

  TransferKernels<Real, D> kernels_;
  GridKernels<Real, D> grid_kernels_;
  const MaterialKernel<Real>* updates_;  // by the index of the model in Material
  std::vector<BatchTask<Real>> tasks_;   // block by block, then by batch
  Sorter<QuadraticKernel, Real, D> sorter_;
  BlockLayout<D> old_layout_;
  BlockArray<Node<Real, D>, D> grid_, other_grid_;
  Outboxes<Real, D> outboxes_;
  std::vector<LineSet> lines_, new_lines_;  // by block with particles: of its outbox, now and after the pass
  std::vector<StepEffect<Real, D>> effects_;
  std::vector<StillCollider<Real, D>> still_;
  std::vector<MaterialReport> reports_, block_reports_;  // block_reports_: block by block, then by batch
  std::vector<Motion> motions_;
  std::array<BlockSamples, PassTimes::count> samples_;
  BlockSamples grid_samples_;
  Real lightest_;                // kg, of the particles
  bool contacts_known_ = false;  // of still_ in layout_
  double announced_ = 0;         // s; the length of the step whose forces are in the outboxes, or 0
};

}  // namespace firn
