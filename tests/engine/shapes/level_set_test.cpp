#include "engine/shapes/level_set.h"

#include <limits>
#include <numbers>
#include <thread>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "engine/base/error.h"
#include "engine/shapes/mesh_check.h"
#include "engine/shapes/mesh_import.h"
#include "engine/shapes/transformed.h"
#include "tests/engine/shapes/mesh_samples.h"
#include "tests/engine/shapes/sampling.h"
#include "tests/engine/shapes/vdb_samples.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kBall = 4.0 / 3.0 * std::numbers::pi;

struct Result {
  ShapePtr shape;
  std::vector<std::string> warnings;
};

Result convert(const TriangleMesh& mesh, double voxel) {
  Result result;
  result.shape = level_set_from_mesh(mesh, "'m'", voxel, result.warnings);
  return result;
}

std::string failure(const std::function<void()>& work, ExitCode code = ExitCode::input) {
  try {
    work();
  } catch (const Error& error) {
    CHECK(error.code() == code);
    return error.what();
  }
  return "no error";
}

std::string failure(const TriangleMesh& mesh, double voxel, ExitCode code = ExitCode::input) {
  return failure([&] { convert(mesh, voxel); }, code);
}

}  // namespace

TEST_CASE("the level set of a sphere's mesh converges to the sphere") {
  // Both the facets (their sagitta is about h^2 / 8 with edges of h) and trilinear interpolation are of
  // second order.
  double last = 0;
  for (int n : {16, 32, 64}) {
    const double voxel = 2.0 / n;
    const ShapePtr shape = convert(sphere(n), voxel).shape;
    double worst = 0;
    for (const Vec3& x : random_points(4000, Vec3::Constant(-1.2), Vec3::Constant(1.2))) {
      const double exact = x.norm() - 1;
      if (std::abs(exact) < 1.5 * voxel) worst = std::max(worst, std::abs(phi_at(*shape, x) - exact));
    }
    if (last > 0) CHECK(worst < last / 3);  // 4 in the limit
    last = worst;
    // A sphere of n rings has edges of pi / n: its volume is smaller by about (pi / n)^2 / 2, and the level
    // set's own error is of the same order.
    CHECK(*shape->volume() == Approx(kBall).epsilon(8.0 / (n * n)));
  }
  CHECK(last < 2e-3);  // 1/16 of the voxel
}

TEST_CASE("a level set's volume is the mesh's") {
  for (int n : {20, 40}) {
    const TriangleMesh mesh = sphere(60);
    // Between voxels a sphere's distance is interpolated by chords: 0.5 % of the volume at 10 voxels a
    // radius, of second order.
    CHECK(*convert(mesh, 2.0 / n).shape->volume() ==
          Approx(inspect_mesh(mesh, "").volume).epsilon(3.0 / (n * n)));
  }
}

TEST_CASE("a level set's distance has slope one in its band and the right sign everywhere") {
  const double voxel = 0.05;
  const ShapePtr shape = convert(sphere(40), voxel).shape;
  std::size_t wrong = 0;
  for (const Vec3& x : random_points(3000, Vec3::Constant(-3), Vec3::Constant(3))) {
    const double phi = phi_at(*shape, x), exact = x.norm() - 1;
    wrong += std::abs(exact) > 0.01 && (phi < 0) != (exact < 0);
    REQUIRE(std::abs(phi) <= 3 * voxel * 1.0001);  // float rounding of the band
    // 3 %: piecewise linear interpolation of a curved field and 40 facets to a half turn.
    if (std::abs(exact) < 1.2 * voxel)
      CHECK(gradient_at(*shape, x, 0.5 * voxel).norm() == Approx(1).epsilon(0.03));
  }
  CHECK(wrong == 0);
  CHECK(phi_at(*shape, Vec3::Zero()) == Approx(-3 * voxel));
}

TEST_CASE("points far away, infinite or undefined are outside") {
  const ShapePtr shape = convert(cube(), 0.1).shape;
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (double c : {100.0, -1e10, 1e300, inf, -inf, nan}) {
    CHECK(phi_at(*shape, {c, 0.5, 0.5}) == Approx(0.3));
    CHECK(phi_at(*shape, {0.5, 0.5, c}) == Approx(0.3));
  }
}

TEST_CASE("neither a far offset, nor a tiny scale, changes the level set") {
  const TriangleMesh mesh = sphere(24);
  const ShapePtr here = convert(mesh, 0.1).shape;
  const Vec3 offset(1e6, -3e6, 2e6);
  for (double scale : {1.0, 1e-6}) {
    const Vec3 o = scale == 1 ? offset : Vec3::Zero();
    const Result there = convert(placed(mesh, scale, o), 0.1 * scale);
    CHECK(there.warnings.empty());
    CHECK(*there.shape->volume() == Approx(*here->volume() * scale * scale * scale).epsilon(1e-6));
    for (const Vec3& x : random_points(500, Vec3::Constant(-1.3), Vec3::Constant(1.3))) {
      // Doubles of 3e6 carry 5e-10; float distances of 0.3 carry 2e-8, and the mesh's middle may move by as
      // much.
      REQUIRE(phi_at(*there.shape, scale * x + o) / scale == Approx(phi_at(*here, x)).margin(1e-6));
    }
  }
}

TEST_CASE("bounds hold every solid point and are at most two voxels wider") {
  const double voxel = 0.04;
  const Bounds b = convert(sphere(40), voxel).shape->bounds();
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(b.min[axis] <= -1);
    CHECK(b.min[axis] >= -1 - 2 * voxel);
    CHECK(b.max[axis] >= 1);
    CHECK(b.max[axis] <= 1 + 2 * voxel);
  }
}

TEST_CASE("a level set has the same bits for any number of threads, and may be sampled from several") {
  const auto points = random_points(5000, Vec3::Constant(-0.3), Vec3::Constant(1.3));
  std::vector<double> first, first_volume;
  for (int threads : {1, 2, 3, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const ShapePtr shape = convert(joined(cube(), placed(sphere(20), 0.5, {0.9, 0.8, 0.7})), 0.03).shape;
    std::vector<std::vector<double>> phi(2, std::vector<double>(points.size()));
    {
      std::jthread other([&] { shape->distance(points, phi[0]); });
      shape->distance(points, phi[1]);
    }
    CHECK(phi[0] == phi[1]);
    if (first.empty()) {
      first = phi[0];
      first_volume = {*shape->volume()};
    }
    CHECK(phi[0] == first);
    CHECK(*shape->volume() == first_volume[0]);
  }
}

TEST_CASE("an open surface is refused where a voxel falls through the hole") {
  const TriangleMesh open = without_triangle(without_triangle(cube(), 2), 2);
  CHECK_THAT(failure(open, 0.05),
             Contains("'m': the surface is open: 1 hole, the largest 1.41 m wide at (0.5, 0.5, 1), "
                      "where a voxel is 0.05 m") &&
                 Contains("Close the mesh"));
  CHECK_THAT(failure(without_triangle(without_triangle(sphere(24), 300), 300), 0.02),
             Contains("the surface is open: 1 hole"));
}

TEST_CASE("a hole narrower than a voxel is closed with a word") {
  const TriangleMesh mesh = without_triangle(sphere(48), 1000);  // edges of 0.065
  const Result result = convert(mesh, 0.1);
  REQUIRE(result.warnings.size() == 1);
  CHECK_THAT(result.warnings[0],
             Contains("the surface has 1 gap of at most") && Contains("which the level set closes"));
  CHECK(*result.shape->volume() == Approx(kBall).epsilon(0.02));  // coarse: ten voxels a radius
}

TEST_CASE("a mesh inside-out, in pieces or partly turned round is the solid it encloses") {
  const double whole = *convert(sphere(24), 0.05).shape->volume();
  const Result inside_out = convert(flipped(sphere(24)), 0.05);
  CHECK(*inside_out.shape->volume() == Approx(whole));
  REQUIRE(inside_out.warnings.size() == 1);
  CHECK(inside_out.warnings[0] == "'m': the mesh is inside-out; what the surface encloses is solid");

  const Result pieces = convert(soup(sphere(24)), 0.05);
  CHECK(*pieces.shape->volume() == Approx(whole));
  CHECK(pieces.warnings.empty());

  TriangleMesh mixed = sphere(24);
  for (std::size_t i = 0; i < mixed.triangles.size(); i += 3)
    std::swap(mixed.triangles[i][0], mixed.triangles[i][1]);
  const Result turned = convert(mixed, 0.05);
  CHECK(*turned.shape->volume() == Approx(whole));
  REQUIRE(turned.warnings.size() == 1);
  CHECK_THAT(turned.warnings[0], Contains("disagree on which side is out"));
}

TEST_CASE("shells that overlap are united, and a shell inside another is filled, with a word") {
  const Result overlap = convert(joined(cube(), placed(cube(), 1, {0.5, 0, 0})), 0.05);
  CHECK(*overlap.shape->volume() == Approx(1.5).epsilon(0.02));  // edges are rounded by half a voxel
  REQUIRE(overlap.warnings.size() == 1);
  CHECK_THAT(overlap.warnings[0], Contains("the surface encloses 2 m^3: its shells overlap (united)"));

  const Result nested = convert(joined(cube(), flipped(placed(cube(), 0.5, Vec3::Constant(0.25)))), 0.05);
  CHECK(phi_at(*nested.shape, Vec3::Constant(0.5)) < 0);
  REQUIRE(nested.warnings.size() == 1);
  CHECK_THAT(nested.warnings[0], Contains("lie in one another (filled)"));

  const Result apart = convert(joined(cube(), placed(cube(), 1, {3, 0, 0})), 0.05);
  CHECK(*apart.shape->volume() == Approx(2).epsilon(0.02));
  CHECK(apart.warnings.empty());
}

TEST_CASE("a mesh too thin or too large for the voxels is refused with both lengths") {
  TriangleMesh plate = cube();
  for (Vec3& v : plate.vertices) v = rotation_xyz({20, 30, 0}) * Vec3(v.x(), v.y(), 1e-4 * v.z());
  CHECK_THAT(failure(plate, 0.1), Contains("encloses nothing as thick as a voxel of 0.1 m"));
  CHECK_THAT(failure(placed(cube(), 1000, Vec3::Zero()), 1e-3, ExitCode::resources),
             Contains("is 1e+03 x 1e+03 x 1e+03 m") && Contains("in millimetres?"));
}

TEST_CASE("the scenes' meshes are sound") {
  for (const char* name : {"snowball.obj", "snowman.obj"}) {
    const TriangleMesh mesh = import_mesh(std::filesystem::path(FIRN_SOURCE_DIR) / "scenes/meshes" / name);
    const Result result = convert(mesh, 0.01);
    CHECK(result.warnings.empty());
    // The level set rounds off what is finer than its voxels of a twentieth of the radius.
    CHECK(*result.shape->volume() == Approx(inspect_mesh(mesh, name).volume).epsilon(0.01));
  }
}

TEST_CASE("a .vdb level set is read with its place and size") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "s.vdb";
  const Vec3 center(1e4, -20, 3);
  write_vdb_samples(file, 0.5, center, 0.05);
  for (const char* grid : {"", "sphere"}) {
    const ShapePtr shape = read_level_set(file, grid);
    CHECK(*shape->volume() == Approx(kBall / 8).epsilon(0.01));  // ten voxels a radius
    for (const Vec3& x : random_points(500, Vec3::Constant(-0.6), Vec3::Constant(0.6))) {
      // Interpolation error: h^2 / (8 r) in each of two directions, five times that near the band's rim.
      if (std::abs(x.norm() - 0.5) < 0.07)
        CHECK(phi_at(*shape, center + x) == Approx(x.norm() - 0.5).margin(0.004));
      else
        CHECK((phi_at(*shape, center + x) < 0) == (x.norm() < 0.5));
    }
    CHECK(phi_at(*shape, center) == Approx(-0.15));
  }
}

TEST_CASE("a .vdb file without the wanted level set is refused with what it holds") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "s.vdb";
  write_vdb_samples(file, 0.5, Vec3::Zero(), 0.1);
  const auto reading = [&](const std::string& grid) { return failure([&] { read_level_set(file, grid); }); };
  const std::string at = "'" + file.string() + "': ";
  CHECK(reading("ball") == at + "has no grid 'ball'; known: fog, sphere, stretched, void");
  CHECK(reading("fog") == at + "the fog volume is empty");
  CHECK(reading("stretched") == at + "its voxels are not cubes; resample it with a uniform voxel size");
  CHECK(reading("void") == at + "the level set is empty");
  CHECK(failure([] { read_level_set("/nowhere.vdb", ""); }) == "'/nowhere.vdb': no such file");
  CHECK_THAT(failure([&] { read_level_set(folder.write("g.vdb", "garbage garbage garbage"), ""); }),
             Contains("g.vdb': "));
}

TEST_CASE("a damaged .vdb file never takes the program down") {
  const TemporaryFolder folder;
  const auto good = folder.path() / "good.vdb";
  write_vdb_samples(good, 0.3, Vec3::Zero(), 0.1);
  std::ifstream stream(good, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  std::size_t refused = 0;
  for (std::size_t n = 7; n < whole.size(); n += whole.size() / 60) {
    refused +=
        failure([&] { read_level_set(folder.write("cut.vdb", whole.substr(0, n)), "sphere"); }) != "no error";
    std::string changed = whole;
    changed[n] = static_cast<char>(changed[n] ^ 0x41);
    failure([&] { read_level_set(folder.write("changed.vdb", changed), "sphere"); });
  }
  CHECK(refused > 20);  // those cut before the end of the sphere's voxels
}
