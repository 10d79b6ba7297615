// Grid to particles: velocity, position, and the trial elastic deformation F_E <- (I + dt grad v) F_E.
#pragma once

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "engine/passes/batch.h"
#include "engine/passes/reports.h"
#include "engine/passes/transfer.h"

namespace firn {

namespace detail {

template <class Kernel, class Transfer, class Real, int D>
Motion gather(ParticleTable<Real, D>& particles, std::pair<std::size_t, std::size_t> range,
              const BlockCoord<D>& block, Real h, Real dt, Real flip_ratio,
              const Scratch<Node<Real, D>, D>& nodes, const Scratch<Vector<Real, D>, D>* before) {
  const auto position = particles.template view<Column::position>();
  const auto velocity = particles.template view<Column::velocity>();
  const auto deformation = particles.template view<Column::elastic_deformation>();
  const Real reach = h * Real(kMaxCell - 2 * kBlockEdge);
  Motion motion;
  for (std::size_t p = range.first; p < range.second; ++p) {
    const Vector<Real, D> x = position.load(p);
    const Stencil<Kernel, Real, D> stencil(x, Real(1) / h, block);
    auto v = Vector<Real, D>::zero();
    auto change = Vector<Real, D>::zero();
    auto gradient_v = Matrix<Real, D>::zero();
    auto B = Matrix<Real, D>::zero();
    stencil.for_each([&](std::size_t node, Real w, const Vector<Real, D>& gradient,
                         const Vector<Real, D>& offset) {
      const Vector<Real, D>& v_i = nodes.node[node].v;
      v += w * v_i;
      gradient_v = gradient_v + outer(v_i, stencil.template force_gradient<Transfer>(w, gradient, offset));
      if constexpr (Transfer::affine) B = B + outer(w * v_i, offset);
      if constexpr (Transfer::increments) change += w * (v_i - before->node[node]);
    });
    const Vector<Real, D> x_new = x + dt * v;
    position.store(p, x_new);
    Vector<Real, D> v_new = v;
    if constexpr (Transfer::increments)
      v_new = (Real(1) - flip_ratio) * v + flip_ratio * (velocity.load(p) + change);
    velocity.store(p, v_new);
    if constexpr (Transfer::affine)
      particles.template view<Column::affine>().store(p, (Real(Kernel::inverse_inertia) / h) * B);
    const Matrix<Real, D> F = deformation.load(p);
    const Matrix<Real, D> F_trial = F + (dt / h) * (gradient_v * F);
    deformation.store(p, F_trial);

    const Real speed2 = dot(v_new, v_new);
    Real extent = 0, step = 0;
    for (int d = 0; d < D; ++d) {
      extent = std::max(extent, std::abs(x_new[d]));
      step = std::max(step, std::abs(dt * v[d]));
    }
    motion.max_speed = std::max(motion.max_speed, static_cast<double>(speed2));
    motion.max_displacement = std::max(motion.max_displacement, static_cast<double>(step));
    // Written so that a NaN counts.
    const bool valid = extent + Real(0) * (speed2 + frobenius2(F_trial) + dot(x_new, x_new)) <= reach;
    motion.invalid += valid ? 0 : 1;
  }
  motion.max_speed = std::sqrt(motion.max_speed);
  return motion;
}

}  // namespace detail

/// `flip_ratio` is read by FlipTransfer only.
template <class Kernel, class Transfer, class Real, int D>
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
            motion.join(detail::gather<Kernel, Transfer, Real, D>(
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
