#include "engine/scene/seeding.h"

#include <fstream>
#include <map>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "engine/base/error.h"
#include "engine/scene/seeding_cells.h"
#include "engine/scene/seeding_patterns.h"
#include "engine/shapes/combination.h"
#include "engine/shapes/level_set.h"
#include "engine/shapes/primitives.h"
#include "tests/engine/shapes/mesh_samples.h"

using namespace firn;
using Catch::Matchers::Contains;

namespace {

BodyDescription body(double per_cell, Sampling sampling = Sampling::jittered) {
  BodyDescription b;
  b.name = std::string("b");
  b.mark = {"s.toml", 7, 1};
  b.particles_per_cell = per_cell;
  b.sampling = sampling;
  return b;
}

Seeds seed(const ShapePtr& shape, int dimension, double dx, const BodyDescription& b,
           std::uint64_t number = 1, std::size_t index = 0) {
  std::vector<std::string> warnings;
  Seeds seeds = seed_body(b, shape.get(), dimension, dx, number, index, ".", warnings);
  CHECK(warnings.empty());
  return seeds;
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

/// The smallest distance between two points, searched in cells of `reach`, which it must not exceed.
double smallest_distance(const std::vector<Vec3>& points, double reach) {
  std::map<std::array<long, 3>, std::vector<Vec3>> cells;
  double smallest = reach;
  const auto cell = [&](const Vec3& x, int axis) { return std::lround(std::floor(x[axis] / reach)); };
  for (const Vec3& x : points) {
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        for (long k = -1; k <= 1; ++k) {
          const auto found = cells.find({cell(x, 0) + i, cell(x, 1) + j, cell(x, 2) + k});
          if (found == cells.end()) continue;
          for (const Vec3& y : found->second) smallest = std::min(smallest, (x - y).norm());
        }
    cells[{cell(x, 0), cell(x, 1), cell(x, 2)}].push_back(x);
  }
  return smallest;
}

const ShapePtr kBall = make_sphere({0.013, -0.02, 0.007}, 1);

}  // namespace

TEST_CASE("jittered seeding puts exactly 2 x 2 x 2 particles into every interior cell, one per octant") {
  const double dx = 0.1;
  const Seeds seeds = seed(make_box({-0.5, 0, 0.2}, {0.5, 0.4, 0.8}), 3, dx, body(8));
  REQUIRE(seeds.position.size() == 10 * 4 * 6 * 8);
  std::set<std::array<long, 3>> octants;
  for (const Vec3& x : seeds.position) {
    octants.insert({std::lround(std::floor(x.x() * 20)), std::lround(std::floor(x.y() * 20)),
                    std::lround(std::floor(x.z() * 20))});
  }
  CHECK(octants.size() == seeds.position.size());
  CHECK(seeds.volume == Approx(1.0 * 0.4 * 0.6).epsilon(1e-15));
  CHECK(seeds.velocity.empty());
}

TEST_CASE("the number of jittered particles follows the volume") {
  for (const double per_cell : {8.0, 27.0, 10.0}) {
    const double dx = 0.05;
    const Seeds seeds = seed(kBall, 3, dx, body(per_cell));
    const double wanted = *kBall->volume() * per_cell / (dx * dx * dx);
    // Only strata cut by the surface are left to chance: about 4 pi (per_cell^(1/3) / dx)^2 of them, each
    // with a variance of at most 1/4. Four standard deviations: 0.07 % at 8 a cell.
    const double cut = 4 * std::numbers::pi * std::pow(per_cell, 2.0 / 3) / (dx * dx);
    CHECK(std::abs(static_cast<double>(seeds.position.size()) - wanted) < 4 * std::sqrt(cut / 4));
  }
}

TEST_CASE("every particle lies in its shape and none where it was subtracted") {
  const ShapePtr shape = make_difference(
      {make_union({kBall, make_box({0, 0, 0}, {1.5, 0.6, 0.6})}), make_sphere({0.9, 0.3, 0.3}, 0.4)});
  for (const Sampling sampling : {Sampling::jittered, Sampling::lattice, Sampling::poisson}) {
    const Seeds seeds = seed(shape, 3, 0.07, body(8, sampling));
    std::vector<double> phi(seeds.position.size());
    shape->distance(seeds.position, phi);
    CHECK(*std::max_element(phi.begin(), phi.end()) <= 0);
    // The volume of a combination is sampled; its error is of second order in a quarter of a cell: 0.1 %. The
    // count adds the chance of the strata at the surface.
    const double wanted = seeds.volume * 8 / std::pow(0.07, 3);
    CHECK(static_cast<double>(seeds.position.size()) == Approx(wanted).epsilon(0.005));
  }
}

TEST_CASE("interior cells are skipped without changing what is found") {
  // Every point asked for by itself, against whole cells taken as inside.
  const auto pattern = jittered_pattern(3, 0.1, 8, 5, 1);
  const CellBox cells = covering_cells(kBall->bounds(), 3, pattern.cell_size);
  std::vector<Vec3> all, expected;
  for (auto k = cells.begin[2]; k < cells.end[2]; ++k)
    for (auto j = cells.begin[1]; j < cells.end[1]; ++j)
      for (auto i = cells.begin[0]; i < cells.end[0]; ++i) pattern.points_of({i, j, k}, all);
  std::vector<double> phi(all.size());
  kBall->distance(all, phi);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (phi[i] <= 0) expected.push_back(all[i]);
  }
  CHECK(points_inside(*kBall, cells, pattern.points_of) == expected);
}

TEST_CASE("Poisson seeding keeps its distance and its number") {
  for (int dimension : {1, 2, 3}) {
    for (const double per_cell : {dimension == 3 ? 8.0 : 4.0, 5.5}) {
      const double dx = dimension == 3 ? 0.06 : 0.01;
      const Seeds seeds =
          seed(make_sphere(Vec3::Zero(), 1), dimension, dx, body(per_cell, Sampling::poisson));
      const double measure = dimension == 1   ? 2
                             : dimension == 2 ? std::numbers::pi
                                              : 4 * std::numbers::pi / 3;
      CHECK(seeds.volume == Approx(measure).epsilon(1e-4));  // sampled in 1D and 2D
      CHECK(static_cast<double>(seeds.position.size()) ==
            Approx(measure * per_cell / std::pow(dx, dimension)).epsilon(0.01));
      const double wanted = poisson_distance(dimension, dx, per_cell);
      CHECK(smallest_distance(seeds.position, 2 * wanted) >= wanted * (1 - 1e-9));  // rounding
    }
  }
  CHECK(poisson_distance(3, 1, 8) == Approx(0.415));
}

TEST_CASE("seeds depend on the seed and the body only, not on threads") {
  for (const Sampling sampling : {Sampling::jittered, Sampling::lattice, Sampling::poisson}) {
    const auto b = body(8, sampling);
    const ShapePtr shape = make_union({kBall, make_box({0.5, 0.5, 0.5}, {1.1, 1.2, 1.3})});
    std::vector<Vec3> first;
    double volume = 0;
    for (std::size_t threads : {1, 2, 3, 8}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const Seeds seeds = seed(shape, 3, 0.1, b);
      if (first.empty()) {
        first = seeds.position;
        volume = seeds.volume;
      }
      CHECK(seeds.position == first);
      CHECK(seeds.volume == volume);
    }
    const bool random = sampling != Sampling::lattice;
    CHECK((seed(shape, 3, 0.1, b, 2).position != first) == random);
    CHECK((seed(shape, 3, 0.1, b, 1, 1).position != first) == random);
  }
}

TEST_CASE("a body far from the origin is seeded like one at the origin") {
  const double dx = 0.125;  // a power of two, so that the shift keeps the bits of the grid
  const Seeds near = seed(make_sphere({0, 0, 0}, 1), 3, dx, body(8));
  const Seeds far = seed(make_sphere({1e6, -2e6, 0}, 1), 3, dx, body(8));
  CHECK(static_cast<double>(far.position.size()) ==
        Approx(static_cast<double>(near.position.size())).epsilon(0.01));
}

TEST_CASE("jitter is even in its stratum and independent along the axes") {
  const Seeds seeds = seed(make_box({0, 0, 0}, {4, 4, 4}), 3, 0.125, body(1));
  REQUIRE(seeds.position.size() == 32768);
  Vec3 mean = Vec3::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const Vec3& x : seeds.position) {
    const Vec3 u = (x * 8).array() - (x * 8).array().floor() - 0.5;
    mean += u / 32768;
    square += u * u.transpose() / 32768;
  }
  // Standard errors of a mean and a product of uniform numbers: 0.29 / 181 and 0.083 / 181; five of each.
  CHECK(mean.cwiseAbs().maxCoeff() < 5 * 0.29 / 181);
  CHECK((square - Eigen::Matrix3d::Identity() / 12).cwiseAbs().maxCoeff() < 5 * 0.083 / 181);
}

TEST_CASE("without jitter particles are the lattice") {
  const auto pattern = jittered_pattern(2, 1, 4, 9, 0);
  std::vector<Vec3> points;
  pattern.points_of({3, -1, 0}, points);
  CHECK(points == std::vector<Vec3>{{3.25, -0.75, 0}, {3.75, -0.75, 0}, {3.25, -0.25, 0}, {3.75, -0.25, 0}});
}

TEST_CASE("in one and two dimensions bodies are what the line and the plane cut out") {
  const Seeds line = seed(make_box({-0.3, -1, -1}, {0.5, 1, 1}), 1, 0.1, body(4));
  CHECK(line.position.size() == 32);
  CHECK(line.volume == Approx(0.8));
  const Seeds disc = seed(make_sphere({0, 0, 0.6}, 1), 2, 0.02, body(4));
  // The cut through a sphere 0.6 from its middle has radius 0.8; 0.1 %: sampled with sub-cells of 1/16 cell.
  CHECK(disc.volume == Approx(std::numbers::pi * 0.64).epsilon(1e-3));
  CHECK(static_cast<double>(disc.position.size()) == Approx(disc.volume * 4 / 0.0004).epsilon(0.005));
  for (const Vec3& x : disc.position) REQUIRE(x.z() == 0);
}

TEST_CASE("sampled volumes converge with the square of the cell") {
  double last = 0;
  for (double dx : {0.4, 0.2, 0.1}) {
    const double error =
        std::abs(measure(*kBall, covering_cells(kBall->bounds(), 3, dx)) / *kBall->volume() - 1);
    CHECK(error < 0.02 * dx * dx);
    last = error;
  }
  CHECK(last < 2e-4);
}

TEST_CASE("a mesh's particles fill its level set's volume") {
  std::vector<std::string> warnings;
  const ShapePtr ball = level_set_from_mesh(test::sphere(48), "'m'", 0.025, warnings);
  const Seeds seeds = seed(ball, 3, 0.05, body(8));
  CHECK(seeds.volume == *ball->volume());
  // The band integral and the zero contour differ by the 0.14 % that levelSetVolume errs at 40 voxels a
  // radius.
  CHECK(static_cast<double>(seeds.position.size()) ==
        Approx(seeds.volume * 8 / std::pow(0.05, 3)).epsilon(0.001));
}

TEST_CASE("a body without particles is refused with the reason") {
  std::vector<std::string> warnings;
  const auto why = [&](const ShapePtr& shape, int dimension, double dx) {
    return failure([&] { seed_body(body(1), shape.get(), dimension, dx, 1, 0, ".", warnings); });
  };
  CHECK_THAT(why(make_sphere({0.5, 0.5, 0.5}, 1e-4), 3, 1.0),
             Contains("s.toml:7:1: bodies.b: no particles: the shape's bounding box is 0.0002 x 0.0002 x "
                      "0.0002 m and a cell is 1 m") &&
                 Contains("check the shape's units"));
  CHECK_THAT(why(make_intersection({kBall, make_sphere({9, 0, 0}, 1)}), 3, 0.1),
             Contains("the shape is empty"));
  CHECK_THAT(why(make_sphere({0, 0, 5}, 1), 2, 0.1),
             Contains("reaches from z = 4 to 6 m, and a scene in 2 dimensions lies at z = 0"));
  CHECK_THAT(why(make_plane({0, 0, 0}, {0, 1, 0}), 3, 0.1), Contains("intersect a plane with a box"));
}

TEST_CASE("an absurd number of particles is refused before any is made") {
  std::vector<std::string> warnings;
  const std::string text =
      failure([&] { seed_body(body(8), kBall.get(), 3, 1e-9, 1, 0, ".", warnings); }, ExitCode::resources);
  CHECK_THAT(text, Contains("bodies.b: about 3.35e+28 particles, more than the ") &&
                       Contains("choose cell_size >= "));
  CHECK(estimate_count(body(8), kBall.get(), 3, 0.1, ".") == Approx(8000 * 4.18879));
  const ShapePtr both = make_union({kBall, make_sphere({5, 0, 0}, 1)});
  CHECK(estimate_count(body(8), both.get(), 3, 0.01, ".") == Approx(2 * 8e6 * 4.18879).epsilon(0.02));
}

namespace {

/// A ball that claims twice its volume.
class Boaster final : public Shape {
 public:
  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    kBall->distance(points, phi);
  }
  Bounds bounds() const override { return kBall->bounds(); }
  std::optional<double> volume() const override { return 2 * *kBall->volume(); }
};

}  // namespace

TEST_CASE("a body with far fewer particles than its volume calls for gets a warning") {
  std::vector<std::string> warnings;
  seed_body(body(8), std::make_shared<Boaster>().get(), 3, 0.1, 1, 0, ".", warnings);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0],
             Contains("body 'b': ") && Contains("particles where its volume of 8.378 calls for 67021"));
}

namespace {

Seeds from_file(const std::filesystem::path& file, int dimension) {
  BodyDescription b = body(4);
  b.points = Name{file.filename().string(), {}};
  std::vector<std::string> warnings;
  return seed_body(b, nullptr, dimension, 0.5, 1, 0, file.parent_path(), warnings);
}

}  // namespace

TEST_CASE("points are read from CSV, with or without header and velocities") {
  const test::TemporaryFolder folder;
  const Seeds plain = from_file(folder.write("p.csv", "# made by hand\n0,1,2\r\n 3 , -4.5, +1e-3\n\n"), 3);
  CHECK(plain.position == std::vector<Vec3>{{0, 1, 2}, {3, -4.5, 1e-3}});
  CHECK(plain.velocity.empty());
  CHECK(plain.volume == 2 * 0.125 / 4);
  const Seeds named = from_file(folder.write("n.csv", "id;vz;z;y;x;vx;vy\n7;6;3;2;1;4;5\n"), 3);
  CHECK(named.position == std::vector<Vec3>{{1, 2, 3}});
  CHECK(named.velocity == std::vector<Vec3>{{4, 5, 6}});
  const Seeds flat = from_file(folder.write("f.csv", "1 2 3 4\n5\t6 7 8"), 2);
  CHECK(flat.position == std::vector<Vec3>{{1, 2, 0}, {5, 6, 0}});
  CHECK(flat.velocity == std::vector<Vec3>{{3, 4, 0}, {7, 8, 0}});
  CHECK(flat.volume == 2 * 0.25 / 4);
  CHECK(from_file(folder.write("six.csv", "1 2 3 4 5 6\n"), 3).velocity == std::vector<Vec3>{{4, 5, 6}});
}

TEST_CASE("points are read from PLY") {
  const test::TemporaryFolder folder;
  const Seeds seeds = from_file(
      folder.write(
          "p.ply",
          "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
          "property float vx\nproperty float vy\nproperty float vz\nend_header\n1 2 3 4 5 6\n7 8 9 1 2 3\n"),
      3);
  CHECK(seeds.position == std::vector<Vec3>{{1, 2, 3}, {7, 8, 9}});
  CHECK(seeds.velocity == std::vector<Vec3>{{4, 5, 6}, {1, 2, 3}});
}

TEST_CASE("a bad point file is refused at its line") {
  const test::TemporaryFolder folder;
  const auto why = [&](const std::string& text, int dimension = 3) {
    const std::string all = failure([&] { from_file(folder.write("p.csv", text), dimension); });
    const std::size_t at = all.find("p.csv'");
    return at == std::string::npos ? all : all.substr(at);
  };
  CHECK_THAT(why("1,2,3\n4,five,6\n"), Contains("p.csv':2: 'five' is not a number (column y)"));
  CHECK_THAT(why("1,2,3\n4,,6\n"), Contains("p.csv':2: '' is not a number (column y)"));
  CHECK_THAT(why("1,2,3\n4,5\n"), Contains("p.csv':2: 2 values where 3 are expected"));
  CHECK_THAT(why("1,2,3\n4,5,6,\n"), Contains("p.csv':2: 4 values where 3 are expected"));
  CHECK_THAT(why("1,2,3\n1,2,nan\n"), Contains("p.csv':2: the position (1, 2, nan) is not finite"));
  CHECK_THAT(why("1,2,3,0,inf,0\n"), Contains("p.csv':1: the velocity (0, inf, 0) is not finite"));
  CHECK_THAT(why("1,2,1e999\n"), Contains("p.csv':1: '1e999' is not a number"));
  CHECK_THAT(why("1,2,3,4\n"), Contains("p.csv':1: 4 columns; expected 3, or 6 with velocities"));
  CHECK_THAT(why("x,y\n1,2\n"), Contains("p.csv':1: the header has no column 'z'"));
  CHECK_THAT(why("x,y,z,x\n1,2,3,4\n"), Contains("p.csv':1: column 'x' twice"));
  CHECK_THAT(why("1,2,3\n", 2),
             Contains("p.csv':1: the position along z is 3, but must be 0 in 2 dimensions"));
  CHECK_THAT(why("x,y,z\n"), Contains("p.csv': holds no points"));
  CHECK_THAT(why(""), Contains("p.csv': the file is empty"));
  CHECK_THAT(failure([&] { from_file(folder.path() / "none.csv", 3); }),
             Contains("s.toml:7:1: bodies.b: ") && Contains("none.csv': no such file"));
}
