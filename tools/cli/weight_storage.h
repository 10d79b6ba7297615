// Weights S and gradients grad S of particles, had in several ways: computed where they are used, as Firn
// does; computed once a step and stored for each node, as Buzzi, Pedroso & Giacomini 2008 propose with their
// arrays S_pr and G_rpr; or once a step and stored for each axis, their products left to the passes. And the
// two passes that use them, alike but for that: those of the plain path (p2g.h, g2p.h) with PIC, which adds
// least to the weights, by one thread.
//
// A way is a type with
//
//   stored_bytes        per particle
//   prepare()           computes what is stored, if anything is
//   operator()(p, c)    weights of particle p, in the block at c, to call for_each of
//
// For kernels that do not depend on a particle's size. Gradients are by x/h.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/passes/batch.h"

namespace firn {

template <class Kernel, class Real, int D>
class RecomputedWeights {
  static_assert(!Kernel::sized);

 public:
  static constexpr std::size_t stored_bytes = 0;

  RecomputedWeights(const Batch<Real, D>& batch, const BlockLayout<D>&, Real h)
      : position_(batch.particles.template view<Column::position>()), inverse_h_(Real(1) / h) {}

  void prepare() {}
  Stencil<Kernel, Real, D> operator()(std::size_t p, const BlockCoord<D>& block) const {
    return {position_.load(p), Real(0), inverse_h_, block};
  }

 private:
  ColumnView<const Real, D, Rank::vector> position_;
  Real inverse_h_;
};

/// What is stored of a particle when all products are.
template <class Kernel, class Real, int D>
class NodeWeights {
  static constexpr std::size_t kNodes = power(Kernel::nodes, D);

 public:
  explicit NodeWeights(const Stencil<Kernel, Real, D>& stencil) : first_(stencil.first) {
    std::size_t n = 0;
    stencil.for_each([&](std::size_t, Real w, const Vector<Real, D>& gradient, const Vector<Real, D>&) {
      nodes_[n++] = {w, gradient};
    });
  }

  /// Calls visit(scratch index, weight, gradient by x/h) for each node, in the order of Stencil.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t n = 0; n < kNodes; ++n)
      visit(static_cast<std::size_t>(first_ + kPlaces[n]), nodes_[n].S, nodes_[n].G);
  }

 private:
  struct OfNode {
    Real S;
    Vector<Real, D> G;
  };
  /// Where in the scratch the nodes are, counted from the first.
  static constexpr std::array<int, kNodes> kPlaces = [] {
    std::array<int, kNodes> out{};
    for (int n = 0; n < static_cast<int>(kNodes); ++n)
      for (int d = D - 1, rest = n; d >= 0; --d, rest /= Kernel::nodes)
        out[static_cast<std::size_t>(n)] += rest % Kernel::nodes * power(Scratch<int, D>::kEdge, D - 1 - d);
    return out;
  }();

  int first_;
  OfNode nodes_[kNodes];
};

/// A control: the loops of what is stored for each node, but nothing is, each pass computing the nodes of one
/// particle just before it needs them. By what stored ones differ from these, storing them makes a
/// difference.
template <class Kernel, class Real, int D>
class RecomputedByNode {
 public:
  static constexpr std::size_t stored_bytes = 0;

  RecomputedByNode(const Batch<Real, D>& batch, const BlockLayout<D>& layout, Real h)
      : computed_(batch, layout, h) {}

  void prepare() {}
  NodeWeights<Kernel, Real, D> operator()(std::size_t p, const BlockCoord<D>& block) const {
    return NodeWeights<Kernel, Real, D>(computed_(p, block));
  }

 private:
  RecomputedWeights<Kernel, Real, D> computed_;
};

/// Weights that are computed once a step. `Value` is made from a Stencil.
template <class Value, class Kernel, class Real, int D>
class StoredWeights {
 public:
  static constexpr std::size_t stored_bytes = sizeof(Value);

  /// Of at least one particle.
  StoredWeights(const Batch<Real, D>& batch, const BlockLayout<D>& layout, Real h)
      : batch_(batch),
        layout_(layout),
        computed_(batch, layout, h),
        values_(batch.particles.size(), Value(computed_(0, layout.coord(0)))) {}

  void prepare() {
    for (std::size_t block = 0; block < layout_.occupied(); ++block) {
      const auto [first, last] = batch_.range(block);
      // In place: a copy of what is stored for every node would not be cheap.
      for (std::size_t p = first; p < last; ++p)
        std::construct_at(&values_[p], computed_(p, layout_.coord(block)));
    }
  }
  const Value& operator()(std::size_t p, const BlockCoord<D>&) const { return values_[p]; }

 private:
  const Batch<Real, D>& batch_;
  const BlockLayout<D>& layout_;
  RecomputedWeights<Kernel, Real, D> computed_;
  std::vector<Value> values_;
};

template <class Kernel, class Real, int D>
using WeightsByNode = StoredWeights<NodeWeights<Kernel, Real, D>, Kernel, Real, D>;
/// A Stencil is weights and slopes of each axis, and where the particle is between its nodes.
template <class Kernel, class Real, int D>
using WeightsByAxis = StoredWeights<Stencil<Kernel, Real, D>, Kernel, Real, D>;

/// Mass and momentum of the nodes: m_i = sum S m_p, q_i = sum S m_p v_p - dt sum V0_p tau_p grad S.
template <class Weights, class Real, int D>
void scatter_with(const Weights& weights, const Batch<Real, D>& batch, const BlockLayout<D>& layout, Real h,
                  Real dt, BlockArray<Node<Real, D>, D>& grid) {
  const auto velocity = batch.particles.template view<Column::velocity>();
  const auto mass = batch.particles.template view<Column::mass>();
  const auto volume = batch.particles.template view<Column::volume>();
  const auto stress = batch.particles.template view<Column::stress>();
  grid.reset(layout);
  for (const auto& colour : layout.colours())
    for (const std::size_t block : colour) {
      Scratch<Node<Real, D>, D> nodes{};
      const auto [first, last] = batch.range(block);
      for (std::size_t p = first; p < last; ++p) {
        const Real m = mass.load(p);
        const Vector<Real, D> momentum = m * velocity.load(p);
        const Matrix<Real, D> impulse = (-dt * volume.load(p) / h) * stress.load(p);
        weights(p, layout.coord(block))
            .for_each([&](std::size_t n, Real w, const Vector<Real, D>& gradient, const auto&...) {
              nodes.node[n].v += w * momentum + impulse * gradient;
              nodes.node[n].m += w * m;
            });
      }
      const auto& blocks = layout.neighbours(block);
      nodes.for_each([&](const Node<Real, D>& value, int neighbour, int local) {
        Node<Real, D>& node =
            grid.block(blocks[static_cast<std::size_t>(neighbour)])[static_cast<std::size_t>(local)];
        node.v += value.v;
        node.m += value.m;
      });
    }
}

/// Velocity and its gradient at the particles, v = sum S v_i and sum v_i grad S, into the columns `velocity`
/// and `affine` of a table of its own.
template <class Weights, class Real, int D>
void gather_with(const Weights& weights, const Batch<Real, D>& batch, const BlockLayout<D>& layout, Real h,
                 const BlockArray<Node<Real, D>, D>& grid, ParticleTable<Real, D>& out) {
  const auto velocity = out.template view<Column::velocity>();
  const auto velocity_gradient = out.template view<Column::affine>();
  Scratch<Node<Real, D>, D> nodes;
  for (std::size_t block = 0; block < layout.occupied(); ++block) {
    nodes.load(grid, layout.neighbours(block));
    const auto [first, last] = batch.range(block);
    for (std::size_t p = first; p < last; ++p) {
      auto v = Vector<Real, D>::zero();
      auto gradient_v = Matrix<Real, D>::zero();
      weights(p, layout.coord(block))
          .for_each([&](std::size_t n, Real w, const Vector<Real, D>& gradient, const auto&...) {
            const Vector<Real, D>& v_i = nodes.node[n].v;
            v += w * v_i;
            gradient_v = gradient_v + outer(v_i, gradient);
          });
      velocity.store(p, v);
      velocity_gradient.store(p, (Real(1) / h) * gradient_v);
    }
  }
}

}  // namespace firn
