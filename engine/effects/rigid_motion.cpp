#include "engine/effects/rigid_motion.h"

#include <algorithm>

namespace firn {

RigidPose RigidMotion::between(const Key& a, const Key& b, double time) const {
  const double span = b.time - a.time, s = (time - a.time) / span;
  RigidPose pose;
  pose.position = (1 - s) * a.position + s * b.position;
  pose.rotation = a.rotation.slerp(s, b.rotation);
  pose.velocity = (b.position - a.position) / span;
  Eigen::Quaterniond turn = b.rotation * a.rotation.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;  // the shortest arc, as slerp takes it
  const Eigen::AngleAxisd arc(turn);
  pose.angular_velocity = arc.axis() * (arc.angle() / span);
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
    pose.rotation = key.rotation;
    return pose;
  }
  return between(*(next - 1), *next, time);
}

double RigidMotion::max_speed(double radius) const {
  double speed = 0;
  for (std::size_t k = 1; k < keys_.size(); ++k) {
    const RigidPose pose = between(keys_[k - 1], keys_[k], keys_[k - 1].time);
    speed = std::max(speed, pose.velocity.norm() + radius * pose.angular_velocity.norm());
  }
  return speed;
}

}  // namespace firn
