// Where a collider is at a given time: key frames of position and of three angles, all linear in time between
// them, at rest before the first and after the last. Angles, not orientations, so that a key of 720 degrees
// is two turns.
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "engine/shapes/shape.h"

namespace firn {

struct RigidPose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 position = Vec3::Zero();          // m, of the shape's own origin
  Vec3 velocity = Vec3::Zero();          // m/s
  Vec3 angular_velocity = Vec3::Zero();  // rad/s

  Vec3 to_local(const Vec3& x) const { return rotation.conjugate() * (x - position); }
  Vec3 velocity_at(const Vec3& x) const { return velocity + angular_velocity.cross(x - position); }
};

class RigidMotion {
 public:
  struct Key {
    double time;  // s, strictly increasing
    Vec3 position;
    Vec3 angles;  // radians about x, then y, then z
  };

  RigidMotion() = default;  // at rest at the origin
  explicit RigidMotion(std::vector<Key> keys) : keys_(std::move(keys)) {}

  /// Whether it has the same pose at all times.
  bool still() const { return keys_.size() < 2; }
  RigidPose at(double time) const;
  /// A bound on the speed that a point within `radius` of the shape's origin ever has, m/s.
  double max_speed(double radius) const;

 private:
  static RigidPose between(const Key& a, const Key& b, double time);

  std::vector<Key> keys_;
};

}  // namespace firn
