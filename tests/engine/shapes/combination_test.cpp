#include "engine/shapes/combination.h"

#include <catch2/catch.hpp>

#include "engine/shapes/primitives.h"
#include "engine/shapes/transformed.h"
#include "tests/engine/shapes/sampling.h"

using namespace firn;
using namespace firn::test;

namespace {

const ShapePtr kA = make_sphere({0, 0, 0}, 1), kB = make_box({0.2, -0.4, -0.5}, {1.6, 0.9, 0.7}),
               kC = make_cone({-1, 0, 0}, {0.5, 0.5, 0}, 0.5);

std::vector<double> distances(const ShapePtr& shape, const std::vector<Vec3>& x) {
  std::vector<double> phi(x.size());
  shape->distance(x, phi);
  return phi;
}

}  // namespace

TEST_CASE("combinations hold the points their set operation says") {
  // 1001 points: more than one internal piece and no multiple of it.
  const auto x = random_points(1001, Vec3::Constant(-2), Vec3::Constant(2));
  const auto a = distances(kA, x), b = distances(kB, x), c = distances(kC, x);
  const auto either = distances(make_union({kA, kB, kC}), x);
  const auto both = distances(make_intersection({kA, kB}), x);
  const auto less = distances(make_difference({kA, kB, kC}), x);
  for (std::size_t i = 0; i < x.size(); ++i) {
    REQUIRE((either[i] < 0) == (a[i] < 0 || b[i] < 0 || c[i] < 0));
    REQUIRE((both[i] < 0) == (a[i] < 0 && b[i] < 0));
    REQUIRE((less[i] < 0) == (a[i] < 0 && b[i] >= 0 && c[i] >= 0));
  }
}

TEST_CASE("set identities hold to the last bit") {
  const auto x = random_points(500, Vec3::Constant(-2), Vec3::Constant(2));
  CHECK(distances(make_union({kA, kB}), x) == distances(make_union({kB, kA}), x));
  CHECK(distances(make_union({kA, kA}), x) == distances(kA, x));
  CHECK(distances(make_intersection({kA, make_union({kA, kB})}), x) == distances(kA, x));
  CHECK(distances(make_difference({kA, kB, kC}), x) ==
        distances(make_difference({kA, make_union({kB, kC})}), x));
  CHECK(distances(make_union({make_union({kA, kB}), kC}), x) == distances(make_union({kA, kB, kC}), x));
}

TEST_CASE("volumes of parts add up to the whole") {
  const Vec3 low = Vec3::Constant(-1.7), high = Vec3::Constant(1.7);
  const double left = counted_volume(*make_difference({kA, kB}), low, high, 60);
  const double both = counted_volume(*make_intersection({kA, kB}), low, high, 60);
  // The same random points: only those exactly on a surface could count twice.
  CHECK(left + both == Approx(counted_volume(*kA, low, high, 60)).epsilon(1e-12));
}

TEST_CASE("a combination never claims more distance than there is") {
  // Two points on either side of a surface cannot be nearer than their distances to it together.
  const auto shape = make_difference({make_union({kA, kC}), kB});
  const auto x = random_points(1500, Vec3::Constant(-2), Vec3::Constant(2));
  const auto phi = distances(shape, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (std::signbit(phi[i]) == std::signbit(phi[j])) continue;
      REQUIRE((x[i] - x[j]).norm() >= std::abs(phi[i]) + std::abs(phi[j]) - 1e-12);  // rounding
    }
}

TEST_CASE("bounds of combinations hold what they should") {
  const Bounds u = make_union({kA, kB})->bounds();
  CHECK(u.min == Vec3(-1, -1, -1));
  CHECK(u.max == Vec3(1.6, 1, 1));
  const Bounds i = make_intersection({kA, kB})->bounds();
  CHECK(i.min == Vec3(0.2, -0.4, -0.5));
  CHECK(i.max == Vec3(1, 0.9, 0.7));
  CHECK(make_difference({kA, kB})->bounds().max == kA->bounds().max);
  CHECK(make_intersection({kA, make_plane({0, 0, 0}, {0, 1, 0})})->bounds().max == Vec3(1, 1, 1));
  CHECK(make_intersection({kA, make_sphere({5, 0, 0}, 1)})->bounds().empty());
  CHECK(make_union({make_intersection({kA, make_sphere({5, 0, 0}, 1)}), kB})->bounds().max ==
        kB->bounds().max);
  CHECK_FALSE(make_union({kA, kB})->volume());
}

TEST_CASE("a transformed shape is scaled, then turned, then moved") {
  const auto moved = make_transformed(make_box({0, 0, 0}, {1, 2, 3}), 2, {0, 0, 90}, {10, 0, 0});
  // (x, y) -> 2 (-y, x) + (10, 0)
  const Bounds b = moved->bounds();
  CHECK(b.min == Vec3(6, 0, 0));
  CHECK(b.max == Vec3(10, 2, 6));
  CHECK(*moved->volume() == 48);
  const auto same = make_box({6, 0, 0}, {10, 2, 6});
  for (const Vec3& x : random_points(500, {0, -5, -5}, {15, 10, 10})) {
    REQUIRE(phi_at(*moved, x) == Approx(phi_at(*same, x)).margin(1e-13));  // rounding
  }
}

TEST_CASE("rotations are about x, then y, then z") {
  const Eigen::Matrix3d r = rotation_xyz({90, 90, 0});
  // y -> z by the first turn, z -> x by the second.
  CHECK((r * Vec3::UnitY() - Vec3::UnitX()).norm() == 0);
  // z -> x by the second, x -> y by the third.
  CHECK((rotation_xyz({0, 90, 90}) * Vec3::UnitZ() - Vec3::UnitY()).norm() == 0);
  const Eigen::Matrix3d q = rotation_xyz({30, -50, 70});
  CHECK((q * q.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-15);
  CHECK(q.determinant() == Approx(1));
  CHECK(rotation_xyz({360, -720, 180}) == rotation_xyz({0, 0, -180}));
}

TEST_CASE("a turned shape has the distances of the shape turned back, and bounds that hold it") {
  const auto shape = make_cone({0, 0, 0}, {0, 0, 1}, 0.4);
  const Vec3 rotate(20, 130, -75), translate(0.3, -0.2, 1);
  const auto turned = make_transformed(shape, 0.7, rotate, translate);
  const Bounds b = turned->bounds();
  for (const Vec3& x : random_points(2000, Vec3::Constant(-1), Vec3::Constant(1))) {
    const Vec3 y = rotation_xyz(rotate) * (0.7 * x) + translate;
    REQUIRE(phi_at(*turned, y) == Approx(0.7 * phi_at(*shape, x)).margin(1e-14));  // rounding
    if (phi_at(*turned, y) > 0) continue;
    REQUIRE(((y - b.min).array() >= 0).all());
    REQUIRE(((b.max - y).array() >= 0).all());
  }
  CHECK(make_transformed(make_plane({0, 0, 0}, {0, 1, 0}), 1, {0, 0, 30}, {0, 0, 0})
            ->bounds()
            .max.array()
            .isInf()
            .all());
}
