// A constant acceleration of every node.
#pragma once

#include "engine/effects/block_nodes.h"

namespace firn {

struct Gravity {
  Vec3 acceleration;  // m/s^2

  template <class Real, int D>
  void apply(BlockNodes<Real, D>& block, double dt) const {
    const Vector<Real, D> change = to_vector<Real, D>(dt * acceleration);
    for (auto& node : block.nodes) node.v += (node.m > Real(0) ? Real(1) : Real(0)) * change;
  }
};

}  // namespace firn
