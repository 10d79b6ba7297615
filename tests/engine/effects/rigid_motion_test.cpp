#include "engine/effects/rigid_motion.h"

#include <numbers>

#include <catch2/catch.hpp>

using namespace firn;

namespace {

constexpr double kDegree = std::numbers::pi / 180;

RigidMotion sweep() {
  return RigidMotion({{1, Vec3(0, 0, 0), Vec3::Zero()},
                      {3, Vec3(4, 0, 0), kDegree * Vec3(20, -50, 90)},
                      {4, Vec3(4, 2, 0), kDegree * Vec3(20, -50, 90)}});
}

}  // namespace

TEST_CASE("a collider without key frames rests at the origin") {
  const RigidPose pose = RigidMotion().at(5);
  CHECK(pose.position.norm() == 0);
  CHECK(pose.velocity_at(Vec3(1, 2, 3)).norm() == 0);
}

TEST_CASE("before the first key frame and after the last it is at rest") {
  CHECK(sweep().at(0.5).velocity_at(Vec3(7, 7, 7)).norm() == 0);
  CHECK(sweep().at(9).velocity_at(Vec3(7, 7, 7)).norm() == 0);
  CHECK((sweep().at(9).position - Vec3(4, 2, 0)).norm() == 0);
}

TEST_CASE("velocity is the rate of what the pose does, at every time") {
  const RigidMotion motion = sweep();
  const Vec3 local(0.3, -0.2, 0.5);
  const double e = 1e-5;
  for (double t = 1.1; t < 4; t += 0.23) {
    const auto place = [&](double time) {
      const RigidPose pose = motion.at(time);
      return Vec3(pose.rotation * local + pose.position);
    };
    const Vec3 rate = (place(t + e) - place(t - e)) / (2 * e);
    // Differences: e^2 times the third derivative, and rounding / e.
    CHECK((motion.at(t).velocity_at(place(t)) - rate).norm() < 1e-9);
    CHECK((motion.at(t).to_local(place(t)) - local).norm() < 1e-14);
  }
}

TEST_CASE("the greatest speed bounds every point's speed") {
  const RigidMotion motion = sweep();
  const double bound = motion.max_speed(1.0);
  CHECK(bound == Approx(2 + 160 * kDegree / 2));
  for (double t = 0; t < 5; t += 0.1)
    CHECK(motion.at(t).velocity_at(motion.at(t).position + Vec3(0, 1, 0)).norm() <= bound);
}

TEST_CASE("a key frame of a whole turn is a turn") {
  const RigidMotion turn({{0, Vec3::Zero(), Vec3::Zero()}, {2, Vec3::Zero(), Vec3(0, 0, 360 * kDegree)}});
  CHECK(turn.at(0.5).angular_velocity.z() == Approx(std::numbers::pi));
  CHECK((turn.at(0.5).rotation * Vec3::UnitX() - Vec3::UnitY()).norm() < 1e-15);
}
