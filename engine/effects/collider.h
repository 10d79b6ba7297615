// A rigid body that the material cannot enter: grid nodes inside it take on its contact condition. Sampled
// only in blocks that its bounds meet.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "engine/base/bits.h"
#include "engine/effects/block_nodes.h"
#include "engine/effects/contact.h"
#include "engine/effects/rigid_motion.h"

namespace firn {

struct Collider {
  std::string name;
  ShapePtr shape;
  Contact contact = Contact::separating;
  double friction = 0;
  RigidMotion motion;
};

/// A set of nodes of a block, one bit each.
using NodeSet = std::uint64_t;

/// A collider where it is during one step.
class PosedCollider {
 public:
  PosedCollider(const Collider& collider, double time);

  template <class Real, int D>
  void apply(BlockNodes<Real, D>& block, double dt) const {
    static_cast<void>(dt);
    for_each_bit(inside(block), [&](std::size_t n) {
      if (block.nodes[n].m > Real(0)) hold(block, n, normal<Real, D>(block.position(n), block.h));
    });
  }

  /// The nodes of the block that lie in the collider.
  template <class Real, int D>
  NodeSet inside(const BlockNodes<Real, D>& block) const {
    if (!may_touch(block.position(0), block.position(kBlockNodes<D> - 1))) return 0;
    std::array<Vec3, kBlockNodes<D>> points;
    std::array<double, kBlockNodes<D>> phi;
    for (std::size_t n = 0; n < points.size(); ++n) points[n] = pose_.to_local(block.position(n));
    collider_->shape->distance(points, phi);
    NodeSet out = 0;
    for (std::size_t n = 0; n < phi.size(); ++n) out |= NodeSet{phi[n] <= 0} << n;
    return out;
  }

  /// The way out from `x` within the D axes of the scene, unit or zero.
  template <class Real, int D>
  Vector<Real, D> normal(const Vec3& x, double h) const {
    Vec3 n = outward(pose_.to_local(x), h);
    for (int d = D; d < 3; ++d) n[d] = 0;
    const double length = n.norm();
    return to_vector<Real, D>(length > 0 ? Vec3(n / length) : n);
  }

  /// What contact makes of node `n`.
  template <class Real, int D>
  void hold(BlockNodes<Real, D>& block, std::size_t n, const Vector<Real, D>& normal) const {
    const Vector<Real, D> wall = to_vector<Real, D>(pose_.velocity_at(block.position(n)));
    const Real friction = static_cast<Real>(collider_->friction);
    Vector<Real, D>& v = block.nodes[n].v;
    v = contact_velocity(collider_->contact, friction, v, wall, normal);
    // A two-sided condition holds before the forces too: its nodes have no rate (Buzzi et al., figure 21).
    if (!block.before.empty() && collider_->contact != Contact::separating)
      block.before[n] = contact_velocity(collider_->contact, Real(0), block.before[n], wall, normal);
  }

 private:
  /// Whether the box from `low` to `high` may hold a point of the collider: by bounds, then by one distance.
  bool may_touch(const Vec3& low, const Vec3& high) const;

  /// Gradient of the distance, unit or zero, in world axes.
  Vec3 outward(const Vec3& local, double h) const;

  const Collider* collider_;
  RigidPose pose_;
  Bounds bounds_;  // in the world
};

}  // namespace firn
