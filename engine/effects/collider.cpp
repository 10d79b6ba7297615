#include "engine/effects/collider.h"

namespace firn {
namespace {

Bounds moved(const Bounds& local, const RigidPose& pose) {
  if (!local.min.allFinite() || !local.max.allFinite()) {
    Bounds all;
    all.max.setConstant(std::numeric_limits<double>::infinity());
    all.min = -all.max;
    return all;
  }
  const Vec3 centre = pose.rotation * Vec3((local.min + local.max) / 2) + pose.position;
  const Vec3 half = pose.rotation.toRotationMatrix().cwiseAbs() * Vec3((local.max - local.min) / 2);
  return {centre - half, centre + half};
}

}  // namespace

PosedCollider::PosedCollider(const Collider& collider, double time)
    : collider_(&collider),
      pose_(collider.motion.at(time)),
      bounds_(moved(collider.shape->bounds(), pose_)) {}

bool PosedCollider::may_touch(const Vec3& low, const Vec3& high) const {
  if ((low.array() > bounds_.max.array()).any() || (high.array() < bounds_.min.array()).any()) return false;
  const Vec3 centre = pose_.to_local((low + high) / 2);
  double phi = 0;
  collider_->shape->distance({&centre, 1}, {&phi, 1});
  // A distance is never more than the true one, so nothing nearer than it can be inside.
  return phi <= (high - low).norm() / 2;
}

Vec3 PosedCollider::outward(const Vec3& local, double h) const {
  const double e = 0.05 * h;  // well inside a cell, well above rounding
  std::array<Vec3, 6> points;
  std::array<double, 6> phi;
  for (std::size_t i = 0; i < 6; ++i)
    points[i] = local + (i % 2 == 0 ? e : -e) * Vec3::Unit(static_cast<int>(i / 2));
  collider_->shape->distance(points, phi);
  const Vec3 gradient(phi[0] - phi[1], phi[2] - phi[3], phi[4] - phi[5]);
  const double length = gradient.norm();
  // Where opposite sides are equally near, or beyond the band of a level set, there is no direction out.
  return length > 0.02 * e ? Vec3(pose_.rotation * (gradient / length)) : Vec3(Vec3::Zero());
}

}  // namespace firn
