#include "engine/shapes/mesh_check.h"

#include <limits>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/engine/shapes/mesh_samples.h"

using namespace firn;
using namespace firn::test;

namespace {

std::string failure(const TriangleMesh& mesh) {
  try {
    inspect_mesh(mesh, "'m'");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::input);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a closed cube has its volume, area and no holes") {
  const MeshReport report = inspect_mesh(cube(), "'m'");
  CHECK(report.volume == Approx(1));
  CHECK(report.area == Approx(6));
  CHECK(report.holes.empty());
  CHECK(report.consistent);
  CHECK(inspect_mesh(flipped(cube()), "'m'").volume == Approx(-1));
}

TEST_CASE("vertices at equal positions are one vertex") {
  const MeshReport report = inspect_mesh(soup(cube()), "'m'");
  CHECK(report.holes.empty());
  CHECK(report.volume == Approx(1));
  TriangleMesh zeros = soup(cube());
  for (Vec3& v : zeros.vertices) v = v.unaryExpr([](double c) { return c == 0 ? -0.0 : c; });
  zeros.vertices[0] = Vec3::Zero();
  CHECK(inspect_mesh(zeros, "'m'").holes.empty());
}

TEST_CASE("triangles without area and triangles that stand there twice do not count") {
  TriangleMesh m = cube();
  m.triangles.push_back({0, 0, 5});
  m.triangles.push_back(m.triangles[3]);
  std::swap(m.triangles.back()[0], m.triangles.back()[2]);
  const MeshReport report = inspect_mesh(m, "'m'");
  CHECK(report.mesh.triangles.size() == 12);
  CHECK(report.holes.empty());
  CHECK(report.consistent);
}

TEST_CASE("holes are found with their place and size, and capped for the volume") {
  TriangleMesh m = without_triangle(without_triangle(cube(), 2), 2);  // no lid at z = 1
  const MeshReport report = inspect_mesh(m, "'m'");
  REQUIRE(report.holes.size() == 1);
  CHECK(report.holes[0].edges == 4);
  CHECK(report.holes[0].size == Approx(std::sqrt(2)));
  CHECK((report.holes[0].center - Vec3(0.5, 0.5, 1)).norm() < 1e-12);
  CHECK(report.volume == Approx(1));
  CHECK(inspect_mesh(flipped(m), "'m'").volume == Approx(-1));

  const TriangleMesh far = placed(without_triangle(sphere(12), 40), 1, {5, 0, 0});
  const MeshReport two = inspect_mesh(joined(m, far), "'m'");
  REQUIRE(two.holes.size() == 2);
  CHECK(two.holes[0].size > two.holes[1].size);
  CHECK(two.holes[1].edges == 3);
}

TEST_CASE("a triangle turned round makes the mesh inconsistent but not open") {
  TriangleMesh m = sphere(8);
  std::swap(m.triangles[30][0], m.triangles[30][1]);
  const MeshReport report = inspect_mesh(m, "'m'");
  CHECK_FALSE(report.consistent);
  CHECK(report.holes.empty());
}

TEST_CASE("a mesh that cannot bound a solid is refused with the reason") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  CHECK(failure({}) == "'m': holds no triangles; export a polygon mesh");
  CHECK(failure({{Vec3::Zero()}, {}}) == "'m': holds only points or lines; export a polygon mesh");
  TriangleMesh m = cube();
  m.vertices[2].y() = nan;
  CHECK(failure(m) == "'m': vertex 3 of 8 is (0, nan, 0), not a finite position; export the mesh again");
  m.vertices[2].y() = -inf;
  CHECK(failure(m) == "'m': vertex 3 of 8 is (0, -inf, 0), not a finite position; export the mesh again");
  m = cube();
  m.triangles[4][1] = 99;
  CHECK(failure(m) == "'m': triangle 5 uses vertex 99 of 8");
  m = cube();
  for (Vec3& v : m.vertices) v.y() = 3;
  CHECK(failure(m) ==
        "'m': is flat: every vertex has the same y; a body needs a closed surface with thickness");
  CHECK(failure(placed(cube(), 0, {1, 1, 1})) == "'m': every triangle has collapsed to a line or a point");
}

TEST_CASE("volume and holes do not suffer far from the origin") {
  const MeshReport report = inspect_mesh(placed(cube(), 1, {1e6, -1e6, 1e6}), "'m'");
  CHECK(report.volume == Approx(1).epsilon(1e-9));  // coordinates of 1e6 carry 1e-10
}
