// Grid to particles: velocity, position, and the trial elastic deformation F_E <- (I + dt grad v) F_E,
// together or one by one.
#pragma once

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "engine/passes/batch.h"
#include "engine/passes/reports.h"
#include "engine/passes/transfer.h"

namespace firn {

/// What a pass takes over from the grid.
struct Gathered {
  bool velocity = false, position = false, deformation = false;
};
inline constexpr Gathered kGatherAll{true, true, true};

namespace detail {

template <class Kernel, class Transfer, Gathered what, class Real, int D>
Motion gather(ParticleTable<Real, D>& particles, std::pair<std::size_t, std::size_t> range,
              const BlockCoord<D>& block, Real h, Real dt, Real flip_ratio,
              const Scratch<Node<Real, D>, D>& nodes, const Scratch<Vector<Real, D>, D>* before) {
  const auto position = particles.template view<Column::position>();
  const auto velocity = particles.template view<Column::velocity>();
  const auto volume = particles.template view<Column::volume>();
  const auto deformation = particles.template view<Column::elastic_deformation>();
  const Real reach = h * Real(kMaxCell - 2 * kBlockEdge);
  constexpr bool affine = Transfer::affine && what.velocity,
                 increments = Transfer::increments && what.velocity;
  Motion motion;
  for (std::size_t p = range.first; p < range.second; ++p) {
    const Vector<Real, D> x = position.load(p);
    const Real size = particle_size<Kernel, Real, D>(volume.load(p), Real(1) / h);
    const Stencil<Kernel, Real, D> stencil(x, size, Real(1) / h, block);
    auto v = Vector<Real, D>::zero();
    auto change = Vector<Real, D>::zero();
    auto gradient_v = Matrix<Real, D>::zero();
    auto B = Matrix<Real, D>::zero();
    stencil.for_each([&](std::size_t node, Real w, const Vector<Real, D>& gradient,
                         const Vector<Real, D>& offset) {
      const Vector<Real, D>& v_i = nodes.node[node].v;
      v += w * v_i;
      if constexpr (what.deformation)
        gradient_v = gradient_v + outer(v_i, stencil.template force_gradient<Transfer>(w, gradient, offset));
      if constexpr (affine) B = B + outer(w * v_i, offset);
      if constexpr (increments) change += w * (v_i - before->node[node]);
    });
    // Written so that a NaN counts.
    Real extent = 0, sum = 0;
    if constexpr (what.position) {
      const Vector<Real, D> x_new = x + dt * v;
      position.store(p, x_new);
      Real step = 0;
      for (int d = 0; d < D; ++d) {
        extent = std::max(extent, std::abs(x_new[d]));
        step = std::max(step, std::abs(dt * v[d]));
      }
      motion.max_displacement = std::max(motion.max_displacement, static_cast<double>(step));
      sum += dot(x_new, x_new);
    }
    if constexpr (what.velocity) {
      Vector<Real, D> v_new = v;
      if constexpr (increments) v_new = (Real(1) - flip_ratio) * v + flip_ratio * (velocity.load(p) + change);
      velocity.store(p, v_new);
      const Real speed2 = dot(v_new, v_new);
      motion.max_speed = std::max(motion.max_speed, static_cast<double>(speed2));
      sum += speed2;
    }
    if constexpr (affine)
      particles.template view<Column::affine>().store(p, (Real(Kernel::inverse_inertia) / h) * B);
    if constexpr (what.deformation) {
      const Matrix<Real, D> F = deformation.load(p);
      const Matrix<Real, D> F_trial = F + (dt / h) * (gradient_v * F);
      deformation.store(p, F_trial);
      sum += frobenius2(F_trial);
    }
    const bool valid = extent + Real(0) * sum <= reach;
    motion.invalid += valid ? 0 : 1;
  }
  motion.max_speed = std::sqrt(motion.max_speed);
  return motion;
}

}  // namespace detail

/// `flip_ratio` is read by FlipTransfer only.
template <class Kernel, class Transfer, class Real, int D, Gathered what = kGatherAll>
Motion g2p(std::span<Batch<Real, D>> batches, const BlockLayout<D>& layout, Real h, Real dt, Real flip_ratio,
           const GridNodes<Real, D>& grid) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, layout.occupied(), 1), Motion{},
      [&](const tbb::blocked_range<std::size_t>& range, Motion motion) {
        Scratch<Node<Real, D>, D> nodes;
        Scratch<Vector<Real, D>, D> before;
        for (std::size_t block = range.begin(); block < range.end(); ++block) {
          nodes.load(grid.nodes, layout.neighbours(block));
          if constexpr (Transfer::increments) before.load(grid.before, layout.neighbours(block));
          for (Batch<Real, D>& batch : batches)
            motion.join(detail::gather<Kernel, Transfer, what, Real, D>(
                batch.particles, batch.range(block), layout.coord(block), h, dt, flip_ratio, nodes, &before));
        }
        return motion;
      },
      [](Motion a, const Motion& b) {
        a.join(b);
        return a;
      });
}

}  // namespace firn
