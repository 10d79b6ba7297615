#include "engine/effects/rigid_motion.h"

#include <algorithm>

namespace firn {

namespace {

Eigen::Quaterniond orientation(const Vec3& angles) {
  return Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
         Eigen::AngleAxisd(angles.x(), Vec3::UnitX());
}

/// Each angle turns about an axis that the later ones carry along.
Vec3 angular_velocity(const Vec3& angles, const Vec3& rate) {
  const Eigen::AngleAxisd z(angles.z(), Vec3::UnitZ()), y(angles.y(), Vec3::UnitY());
  return rate.z() * Vec3::UnitZ() + rate.y() * (z * Vec3::UnitY()) + rate.x() * (z * (y * Vec3::UnitX()));
}

}  // namespace

RigidPose RigidMotion::between(const Key& a, const Key& b, double time) {
  const double span = b.time - a.time, s = (time - a.time) / span;
  const Vec3 angles = (1 - s) * a.angles + s * b.angles;
  RigidPose pose;
  pose.position = (1 - s) * a.position + s * b.position;
  pose.rotation = orientation(angles);
  pose.velocity = (b.position - a.position) / span;
  pose.angular_velocity = angular_velocity(angles, (b.angles - a.angles) / span);
  return pose;
}

RigidPose RigidMotion::at(double time) const {
  if (keys_.empty()) return {};
  const auto next =
      std::upper_bound(keys_.begin(), keys_.end(), time, [](double t, const Key& k) { return t < k.time; });
  if (next == keys_.begin() || next == keys_.end()) {
    const Key& key = next == keys_.begin() ? keys_.front() : keys_.back();
    RigidPose pose;
    pose.position = key.position;
    pose.rotation = orientation(key.angles);
    return pose;
  }
  return between(*(next - 1), *next, time);
}

double RigidMotion::max_speed(double radius) const {
  double speed = 0;
  for (std::size_t k = 1; k < keys_.size(); ++k) {
    const Key &a = keys_[k - 1], &b = keys_[k];
    const double turning = (b.angles - a.angles).lpNorm<1>();  // the axes may come to agree
    speed = std::max(speed, ((b.position - a.position).norm() + radius * turning) / (b.time - a.time));
  }
  return speed;
}

}  // namespace firn
