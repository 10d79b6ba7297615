// The six walls of an axis-aligned box that the material stays inside (four in 2D, two in 1D).
#pragma once

#include "engine/effects/block_nodes.h"
#include "engine/effects/contact.h"

namespace firn {

struct DomainWalls {
  Vec3 min, max;  // m
  Contact contact = Contact::separating;
  double friction = 0;

  template <class Real, int D>
  void apply(BlockNodes<Real, D>& block, double dt) const {
    static_cast<void>(dt);
    if (inside(block.position(0)) && inside(block.position(kBlockNodes<D> - 1))) return;
    const auto still = Vector<Real, D>::zero();
    for (std::size_t n = 0; n < block.nodes.size(); ++n) {
      if (!(block.nodes[n].m > Real(0))) continue;
      const Vec3 x = block.position(n);
      for (int d = 0; d < D; ++d) {
        if (x[d] > min[d] && x[d] < max[d]) continue;
        auto normal = Vector<Real, D>::zero();
        normal[d] = x[d] <= min[d] ? Real(1) : Real(-1);
        block.nodes[n].v =
            contact_velocity(contact, static_cast<Real>(friction), block.nodes[n].v, still, normal);
        if (!block.before.empty() && contact != Contact::separating)
          block.before[n] = contact_velocity(contact, Real(0), block.before[n], still, normal);
      }
    }
  }

 private:
  bool inside(const Vec3& x) const {
    return (x.array() > min.array()).all() && (x.array() < max.array()).all();
  }
};

}  // namespace firn
