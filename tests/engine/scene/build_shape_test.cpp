#include "engine/scene/build_shape.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/shapes/primitives.h"
#include "tests/engine/shapes/mesh_samples.h"
#include "tests/engine/shapes/sampling.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

ShapeDescription describe(ShapeDescription::Kind kind, int line = 3) {
  ShapeDescription d{std::move(kind), {"s.toml", line, 1}};
  return d;
}

struct Built {
  ShapePtr shape;
  std::vector<std::string> warnings;
  std::string problems;
};

Built build(const ShapeDescription& d, const std::filesystem::path& folder = ".", double voxel = 0.05) {
  Built built;
  Problems problems;
  built.shape = build_shape(d, folder, voxel, built.warnings, problems, "bodies[0].shape");
  built.problems = problems.text();
  CHECK((built.shape == nullptr) == !problems.empty());
  return built;
}

}  // namespace

TEST_CASE("descriptions become the shapes they describe, placed") {
  ShapeDescription d = describe(SphereDescription{{1, 0, 0}, 0.5});
  d.scale = 2;
  d.rotate = {0, 0, 90};
  d.translate = {0, 0, 1};
  const ShapePtr same = make_sphere({0, 2, 1}, 1);
  const Built built = build(d);
  for (const Vec3& x : random_points(100, Vec3::Constant(-3), Vec3::Constant(3))) {
    REQUIRE(phi_at(*built.shape, x) == Approx(phi_at(*same, x)).margin(1e-14));  // rounding
  }
}

TEST_CASE("operands are built with their own placement") {
  using Operation = CombinationDescription::Operation;
  ShapeDescription hole = describe(CylinderDescription{{0, 0, -1}, {0, 0, 1}, 0.2});
  hole.translate = {0.5, 0.5, 0};
  const auto block = describe(BoxDescription{{0, 0, 0}, {1, 1, 1}});
  const Built less = build(describe(CombinationDescription{Operation::subtract, {block, hole}}));
  CHECK(phi_at(*less.shape, {0.5, 0.5, 0.5}) == Approx(0.2));
  CHECK(phi_at(*less.shape, {0.1, 0.1, 0.5}) == Approx(-0.1));
  const auto plane = describe(PlaneDescription{{0, 0.25, 0}, {0, 1, 0}});
  CHECK(
      build(describe(CombinationDescription{Operation::intersect, {block, plane}})).shape->bounds().max.y() ==
      1);
  const auto cone = describe(ConeDescription{{0, 1, 0}, {0, 2, 0}, 0.5});
  CHECK(phi_at(*build(describe(CombinationDescription{Operation::unite, {block, cone}})).shape, {0, 1.5, 0}) <
        0);
}

TEST_CASE(
    "a mesh is read relative to the scene's folder, with voxels of the scene's size whatever its scale") {
  const TemporaryFolder folder;
  folder.write("ball.obj", obj_text(placed(sphere(24), 1000, Vec3::Zero())));  // in millimetres
  ShapeDescription d = describe(MeshDescription{{"ball.obj", {"s.toml", 4, 8}}});
  d.scale = 1e-3;
  const Built built = build(d, folder.path());
  REQUIRE(built.shape);
  CHECK(built.warnings.empty());
  CHECK(*built.shape->volume() == Approx(4.15).epsilon(0.01));  // a sphere of 24 rings has 1 % less than 4.19
  CHECK(phi_at(*built.shape, Vec3::Zero()) == Approx(-0.15));   // three voxels of 0.05 m
}

TEST_CASE("what is wrong with a shape is told at its place in the scene, all of it") {
  CHECK(build(describe(SphereDescription{{0, 0, 0}, -1})).problems ==
        "s.toml:3:1: bodies[0].shape.radius: must be greater than 0");
  CHECK_THAT(build(describe(BoxDescription{{0, 1, 0}, {1, 1, 1}})).problems,
             Contains("shape.max: must be greater than min"));
  CHECK_THAT(build(describe(CylinderDescription{{1, 1, 1}, {1, 1, 1}, 1})).problems, Contains("shape.end: "));
  CHECK_THAT(build(describe(ConeDescription{{1, 1, 1}, {1, 1, 1}, 1})).problems, Contains("shape.apex: "));
  CHECK_THAT(build(describe(PlaneDescription{{1, 1, 1}, {0, 0, 0}})).problems, Contains("shape.normal: "));
  ShapeDescription d = describe(SphereDescription{{0, 0, 0}, 1});
  d.scale = 0;
  CHECK_THAT(build(d).problems, Contains("shape.scale: must be greater than 0"));

  const auto file = describe(MeshDescription{{"no.obj", {"s.toml", 5, 10}}}),
             grid = describe(LevelSetDescription{{"no.vdb", {"s.toml", 6, 10}}, "", {}});
  const std::string both =
      build(describe(CombinationDescription{CombinationDescription::Operation::unite, {file, grid}}))
          .problems;
  CHECK_THAT(
      both, Contains("s.toml:5:10: bodies[0].shape.operands[0].file: ") && Contains("no.obj': no such file"));
  CHECK_THAT(
      both, Contains("s.toml:6:10: bodies[0].shape.operands[1].file: ") && Contains("no.vdb': no such file"));
  CHECK_THAT(build(describe(CombinationDescription{CombinationDescription::Operation::unite, {}})).problems,
             Contains("at least one shape"));
}

TEST_CASE("a mesh whose solid is doubtful comes with a warning that names the file") {
  const TemporaryFolder folder;
  folder.write("out.obj", obj_text(flipped(cube())));
  const Built built = build(describe(MeshDescription{{"out.obj", {}}}), folder.path());
  REQUIRE(built.warnings.size() == 1);
  CHECK_THAT(built.warnings[0], Contains("out.obj': the mesh is inside-out"));
  folder.write("open.obj", obj_text(without_triangle(without_triangle(cube(), 2), 2)));
  CHECK_THAT(build(describe(MeshDescription{{"open.obj", {}}}), folder.path()).problems,
             Contains("s.toml:3:1: bodies[0].shape.file: ") && Contains("open.obj': the surface is open"));
}
