#include "engine/shapes/primitives.h"

#include <functional>
#include <numbers>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "tests/engine/shapes/sampling.h"

using namespace firn;
using namespace firn::test;

namespace {

const Vec3 kLow(-3, -3, -3), kHigh(3, 3, 3);
const Vec3 kStart(-0.4, 0.2, -0.3), kEnd(0.9, 1.1, 0.8);

struct Sample {
  const char* name;
  ShapePtr shape;
  std::function<bool(const Vec3&)> inside;  // straight from the definition of the solid
};

std::vector<Sample> samples() {
  const Vec3 axis = (kEnd - kStart).normalized();
  const double length = (kEnd - kStart).norm();
  const auto along = [=](const Vec3& p) { return (p - kStart).dot(axis); };
  const auto radial = [=](const Vec3& p) { return (p - kStart).cross(axis).norm(); };
  return {
      {"sphere", make_sphere({0.1, 0.2, -0.3}, 1.3),
       [](const Vec3& p) { return (p - Vec3(0.1, 0.2, -0.3)).norm() < 1.3; }},
      {"box", make_box({-1, -0.5, 0.2}, {1.5, 0.7, 0.9}),
       [](const Vec3& p) {
         return p.x() > -1 && p.x() < 1.5 && p.y() > -0.5 && p.y() < 0.7 && p.z() > 0.2 && p.z() < 0.9;
       }},
      {"cylinder", make_cylinder(kStart, kEnd, 0.6),
       [=](const Vec3& p) { return along(p) > 0 && along(p) < length && radial(p) < 0.6; }},
      {"cone", make_cone(kStart, kEnd, 0.8),
       [=](const Vec3& p) { return along(p) > 0 && radial(p) < 0.8 * (1 - along(p) / length); }},
      {"plane", make_plane({0.3, 0, 0}, {1, 2, 2}),
       [](const Vec3& p) { return (p - Vec3(0.3, 0, 0)).dot(Vec3(1, 2, 2)) < 0; }},
  };
}

}  // namespace

TEST_CASE("the sign of a primitive's distance follows its definition") {
  for (const Sample& s : samples()) {
    INFO(s.name);
    std::size_t wrong = 0;
    for (const Vec3& x : random_points(20000, kLow, kHigh)) wrong += (phi_at(*s.shape, x) < 0) != s.inside(x);
    CHECK(wrong == 0);
  }
}

// With the right sign these two make a distance exact: no surface point is nearer than |phi| since phi
// changes by no more than the way walked, and one is that near since walking |phi| down the gradient arrives.
TEST_CASE("a primitive's distance is exact") {
  for (const Sample& s : samples()) {
    INFO(s.name);
    const std::vector<Vec3> points = random_points(4000, kLow, kHigh);
    std::size_t arrived = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 &x = points[i], &y = points[(i + 1) % points.size()];
      const double phi = phi_at(*s.shape, x);
      // 1e-12: rounding of coordinates of size 3.
      REQUIRE(std::abs(phi - phi_at(*s.shape, y)) <= (x - y).norm() + 1e-12);
      const Vec3 g = gradient_at(*s.shape, x, 1e-6);
      // The gradient jumps on the medial surface; a difference across it is shorter than 1.
      if (std::abs(g.norm() - 1) > 1e-6) continue;
      ++arrived;
      // 1e-8: the difference quotient's own error, h^2 / distance and rounding / h.
      REQUIRE(std::abs(phi_at(*s.shape, x - phi * g)) < 1e-8 * (1 + std::abs(phi)) + 1e-6 * std::abs(phi));
    }
    CHECK(arrived > points.size() * 99 / 100);
  }
}

TEST_CASE("a primitive's volume and bounds agree with counting its points") {
  for (const Sample& s : samples()) {
    INFO(s.name);
    if (std::string(s.name) == "plane") {
      CHECK_FALSE(s.shape->volume());
      CHECK(s.shape->bounds().max.array().isInf().all());
      continue;
    }
    const Bounds b = s.shape->bounds();
    // Strata of 1/80 of the box: the standard error is about 6/80 * 80^-1.5 of the volume, 1e-4; five times
    // that.
    CHECK(counted_volume(*s.shape, b.min, b.max, 80) == Approx(*s.shape->volume()).epsilon(5e-4));
    std::size_t outside = 0;
    for (const Vec3& x : random_points(50000, kLow, kHigh)) {
      const bool in_box = (x.array() >= b.min.array()).all() && (x.array() <= b.max.array()).all();
      outside += phi_at(*s.shape, x) <= 0 && !in_box;
    }
    CHECK(outside == 0);
  }
}

TEST_CASE("bounds of a tilted cylinder and cone are tight") {
  // Each face of the box touches the solid: somewhere on the face the distance is zero.
  for (const ShapePtr& shape : {make_cylinder(kStart, kEnd, 0.6), make_cone(kStart, kEnd, 0.8)}) {
    const Bounds b = shape->bounds();
    for (int axis = 0; axis < 3; ++axis) {
      for (double side : {b.min[axis], b.max[axis]}) {
        double nearest = 1;
        for (int i = 0; i <= 300; ++i)
          for (int j = 0; j <= 300; ++j) {
            Vec3 x = b.min + Vec3(i, i, j).cwiseProduct(b.max - b.min) / 300;
            if (axis == 0) x = b.min + Vec3(0, i, j).cwiseProduct(b.max - b.min) / 300;
            if (axis == 2) x = b.min + Vec3(i, j, 0).cwiseProduct(b.max - b.min) / 300;
            x[axis] = side;
            nearest = std::min(nearest, phi_at(*shape, x));
          }
        CHECK(nearest < 0.01);    // the face's samples lie 0.007 apart
        CHECK(nearest > -1e-12);  // rounding
      }
    }
  }
}
