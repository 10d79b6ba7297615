// Particles to grid: mass and momentum with the step's internal forces already in it. APIC after Jiang et al.
// 2015, the force after Stomakhin et al. 2013; tau is positive in tension.
//
//   m_i = sum S m_p
//   q_i = sum S m_p (v_p + C_p (x_i - x_p)) - dt sum V0_p tau_p grad S
//
// The force and the update of F (g2p.h) use the same gradient grad S; mixing it with the APIC matrix is
// unstable.
#pragma once

#include <tbb/parallel_for.h>

#include "engine/passes/batch.h"
#include "engine/passes/transfer.h"

namespace firn {
namespace detail {

template <class Kernel, class Transfer, class Real, int D>
void scatter(const ParticleTable<Real, D>& particles, std::pair<std::size_t, std::size_t> range,
             const BlockCoord<D>& block, Real h, Real dt, Scratch<Node<Real, D>, D>& nodes,
             Scratch<Vector<Real, D>, D>* before) {
  const auto position = particles.template view<Column::position>();
  const auto velocity = particles.template view<Column::velocity>();
  const auto mass = particles.template view<Column::mass>();
  const auto volume = particles.template view<Column::volume>();
  const auto stress = particles.template view<Column::stress>();
  for (std::size_t p = range.first; p < range.second; ++p) {
    const Real V0 = volume.load(p);
    const Stencil<Kernel, Real, D> stencil(position.load(p), particle_size<Kernel, Real, D>(V0, Real(1) / h),
                                           Real(1) / h, block);
    const Real m = mass.load(p);
    const Vector<Real, D> momentum = m * velocity.load(p);
    const Matrix<Real, D> impulse = (-dt * V0 / h) * stress.load(p);
    Matrix<Real, D> affine_momentum;
    if constexpr (Transfer::affine)
      affine_momentum = (m * h) * particles.template view<Column::affine>().load(p);
    stencil.for_each(
        [&](std::size_t node, Real w, const Vector<Real, D>& gradient, const Vector<Real, D>& offset) {
          Vector<Real, D> q = momentum;
          if constexpr (Transfer::affine) q += affine_momentum * offset;
          q = w * q;
          if constexpr (Transfer::increments) before->node[node] += q;
          nodes.node[node].v += q + impulse * stencil.template force_gradient<Transfer>(w, gradient, offset);
          nodes.node[node].m += w * m;
        });
  }
}

/// Adds what acts on particles from outside, for a scene that has such forces: q_i += dt sum S f_p.
template <class Kernel, class Real, int D>
void scatter_forces(const ParticleTable<Real, D>& particles, std::pair<std::size_t, std::size_t> range,
                    const BlockCoord<D>& block, Real h, Real dt, Scratch<Node<Real, D>, D>& nodes) {
  const auto position = particles.template view<Column::position>();
  const auto volume = particles.template view<Column::volume>();
  const auto force = particles.template view<Column::force>();
  for (std::size_t p = range.first; p < range.second; ++p) {
    const Stencil<Kernel, Real, D> stencil(
        position.load(p), particle_size<Kernel, Real, D>(volume.load(p), Real(1) / h), Real(1) / h, block);
    const Vector<Real, D> impulse = dt * force.load(p);
    stencil.for_each([&](std::size_t node, Real w, const Vector<Real, D>&, const Vector<Real, D>&) {
      nodes.node[node].v += w * impulse;
    });
  }
}

}  // namespace detail

/// Leaves momentum and mass in `grid.nodes`, and in `grid.before` the momentum without forces where the
/// scheme keeps increments. `h`: cell size, m.
template <class Kernel, class Transfer, class Real, int D>
void p2g(std::span<const Batch<Real, D>> batches, const BlockLayout<D>& layout, Real h, Real dt,
         GridNodes<Real, D>& grid) {
  grid.nodes.reset(layout);
  if constexpr (Transfer::increments) grid.before.reset(layout);
  for (const auto& colour : layout.colours()) {
    tbb::parallel_for(std::size_t{0}, colour.size(), [&](std::size_t k) {
      const std::size_t block = colour[k];
      Scratch<Node<Real, D>, D> nodes{};
      Scratch<Vector<Real, D>, D> before;
      if constexpr (Transfer::increments) before = {};
      for (const Batch<Real, D>& batch : batches) {
        detail::scatter<Kernel, Transfer, Real, D>(batch.particles, batch.range(block), layout.coord(block),
                                                   h, dt, nodes, &before);
        if (dt > Real(0) && batch.particles.columns().has(Column::force))
          detail::scatter_forces<Kernel, Real, D>(batch.particles, batch.range(block), layout.coord(block), h,
                                                  dt, nodes);
      }
      const auto& blocks = layout.neighbours(block);
      nodes.for_each([&](const Node<Real, D>& value, int neighbour, int local) {
        Node<Real, D>& node =
            grid.nodes.block(blocks[static_cast<std::size_t>(neighbour)])[static_cast<std::size_t>(local)];
        node.v += value.v;
        node.m += value.m;
      });
      if constexpr (Transfer::increments)
        before.for_each([&](const Vector<Real, D>& value, int neighbour, int local) {
          grid.before.block(blocks[static_cast<std::size_t>(neighbour)])[static_cast<std::size_t>(local)] +=
              value;
        });
    });
  }
}

}  // namespace firn
