// How fast a particle can become in the step at hand, from the grid alone: what must be known before the
// particles move.
//
// A particle's velocity is the mean of its nodes' with the weights w_i. Nodes that hardly any mass reaches
// can be very fast, for the kernel's gradient falls slower than its weight; but a particle weighs such a node
// no more than w_i <= m_i / m_p. So a component is bounded by the fastest of the heavy nodes plus, for each
// of at most 3^D light ones, |v_i| m_i / m_p.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/grid/nodes.h"

namespace firn {

struct SpeedBound {
  double heavy = 0, light = 0;  // m/s

  void join(const SpeedBound& other) {
    heavy = std::max(heavy, other.heavy);
    light = std::max(light, other.light);
  }
  double value() const { return heavy + light; }
};

/// `lightest`: the least mass of a particle, kg.
template <class Real, int D>
SpeedBound speed_bound(std::span<const Node<Real, D>> nodes, Real lightest) {
  const Real share = Real(kNeighbours<D>) / lightest;
  Real heavy = 0, light = 0, finite = 0;
  for (const auto& node : nodes) {
    if (!(node.m > Real(0))) continue;
    Real speed = 0;
    for (int d = 0; d < D; ++d) {
      speed = std::max(speed, std::abs(node.v[d]));
      finite += Real(0) * node.v[d];  // a maximum would lose a NaN
    }
    const Real part = share * node.m;
    (part < Real(1) ? light : heavy) =
        std::max(part < Real(1) ? light : heavy, std::min(part, Real(1)) * speed);
  }
  if (finite != Real(0)) heavy = std::numeric_limits<Real>::infinity();
  return {static_cast<double>(heavy), static_cast<double>(light)};
}

}  // namespace firn
