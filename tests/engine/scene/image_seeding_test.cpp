// From a picture in a scene to particles.
#include <cmath>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "engine/scene/build_shape.h"
#include "engine/scene/seeding.h"
#include "tests/engine/shapes/mesh_samples.h"
#include "tests/engine/shapes/picture_samples.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kSide = 2, kInner = 0.35, kOuter = 0.8;  // m, of a ring in the middle of the picture
constexpr double kDx = 0.02;
constexpr int kPixels = 200;

/// A ring with soft rims of a pixel.
std::string ring() {
  return gray(kPixels, kPixels, [](int i, int j) {
    constexpr double pixel = kSide / kPixels;
    const double r = std::hypot((i + 0.5) * pixel - kSide / 2, (j + 0.5) * pixel - kSide / 2);
    return std::clamp(0.5 - std::max(r - kOuter, kInner - r) / pixel, 0.0, 1.0);
  });
}

double radius(const Vec3& x) {
  return std::hypot(x.x() - kSide / 2, x.y() - kSide / 2);
}

ShapePtr build(const TemporaryFolder& folder, const ImageDescription& image) {
  std::vector<std::string> warnings;
  Problems problems;
  ShapePtr shape = build_shape({image, {"s.toml", 1, 1}}, folder.path(), kDx / 2, warnings, problems);
  CHECK(problems.text().empty());
  REQUIRE(shape);
  return shape;
}

Seeds seed(const Shape& shape, int dimension, double per_cell, Sampling sampling) {
  BodyDescription body;
  body.name = std::string("foam");
  body.particles_per_cell = per_cell;
  body.sampling = sampling;
  std::vector<std::string> warnings;
  Seeds seeds = seed_body(body, &shape, dimension, kDx, 1, 0, ".", warnings);
  CHECK(warnings.empty());
  return seeds;
}

/// Pieces that particles make where those within `reach` of each other hold together, counted on a lattice of
/// that size.
std::size_t pieces(const std::vector<Vec3>& points, double reach) {
  std::set<std::pair<long, long>> cells;
  for (const Vec3& x : points)
    cells.emplace(std::lround(std::floor(x.x() / reach)), std::lround(std::floor(x.y() / reach)));
  std::size_t count = 0;
  while (!cells.empty()) {
    ++count;
    std::vector<std::pair<long, long>> reached = {*cells.begin()};
    cells.erase(cells.begin());
    while (!reached.empty()) {
      const auto [i, j] = reached.back();
      reached.pop_back();
      for (long di = -1; di <= 1; ++di)
        for (long dj = -1; dj <= 1; ++dj)
          if (cells.erase({i + di, j + dj})) reached.emplace_back(i + di, j + dj);
    }
  }
  return count;
}

}  // namespace

TEST_CASE("a ring in a picture becomes one ring of particles of the right mass, its hole empty") {
  const TemporaryFolder folder;
  folder.write("ring.pgm", ring());
  const ShapePtr shape = build(folder, {{"ring.pgm", {}}, {kSide, kSide, 0}});
  const double area = std::numbers::pi * (kOuter * kOuter - kInner * kInner);
  const double perimeter = 2 * std::numbers::pi * (kOuter + kInner);
  for (const Sampling sampling : {Sampling::jittered, Sampling::lattice, Sampling::poisson}) {
    const Seeds seeds = seed(*shape, 2, 4, sampling);
    const double spacing = kDx / 2;
    // Rims are off by no more than a tenth of a pixel (their bend within a pixel), a pixel being a spacing.
    CHECK(std::abs(seeds.volume - area) < 0.1 * perimeter * spacing);
    // And the particles are those of whole spacings along them.
    const double counted = static_cast<double>(seeds.position.size()) * spacing * spacing;
    CHECK(std::abs(counted - area) < perimeter * spacing);
    for (const Vec3& x : seeds.position) {
      REQUIRE(radius(x) > kInner - 0.2 * spacing);
      REQUIRE(radius(x) < kOuter + 0.2 * spacing);
    }
    CHECK(pieces(seeds.position, kDx) == 1);
  }
}

TEST_CASE("dark pixels are what bright ones leave of the rectangle") {
  const TemporaryFolder folder;
  folder.write("ring.pgm", ring());
  ImageDescription image{{"ring.pgm", {}}, {kSide, kSide, 0}};
  const double bright = seed(*build(folder, image), 2, 4, Sampling::jittered).volume;
  image.solid = SolidPixels::dark;
  const Seeds dark = seed(*build(folder, image), 2, 4, Sampling::jittered);
  CHECK(bright + dark.volume ==
        Approx(kSide * kSide).epsilon(1e-4));  // each sampled, by 16 x 16 points a cell
  CHECK(pieces(dark.position, kDx) == 2);      // the disc in the hole, and what is outside
}

TEST_CASE("in space a picture's body is its area times its depth") {
  const TemporaryFolder folder;
  folder.write("ring.pgm", ring());
  const double depth = 0.3;
  const Seeds seeds =
      seed(*build(folder, {{"ring.pgm", {}}, {kSide, kSide, depth}}), 3, 1, Sampling::jittered);
  const double area = std::numbers::pi * (kOuter * kOuter - kInner * kInner);
  // Cells are sampled at 4 x 4 x 4 points: a tenth of a per cent.
  CHECK(seeds.volume == Approx(area * depth).epsilon(1e-3));
  CHECK(static_cast<double>(seeds.position.size()) == Approx(area * depth / std::pow(kDx, 3)).epsilon(0.005));
  for (const Vec3& x : seeds.position) {
    REQUIRE(radius(x) > kInner - 0.1 * kDx);
    REQUIRE((x.z() >= 0 && x.z() <= depth));
  }
}

TEST_CASE("a closed pore in a stack of slices stays empty") {
  const TemporaryFolder folder;
  constexpr int n = 24;
  const auto from_middle = [](int i, int j, int k) {
    return Vec3(i + 0.5 - n / 2, j + 0.5 - n / 2, k + 0.5 - n / 2).norm();
  };
  for (int k = 0; k < n; ++k) {
    folder.write(fmt::format("s.{:04}.pgm", k), gray(n, n, [&](int i, int j) {
                   const double r = from_middle(i, j, k);
                   return std::clamp(0.5 - std::max(r - 10, 5 - r), 0.0, 1.0);
                 }));
  }
  const double pixel = kDx;
  const ShapePtr shape = build(folder, {{"s.####.pgm", {}}, Vec3::Constant(n * pixel)});
  const Seeds seeds = seed(*shape, 3, 8, Sampling::jittered);
  // Ten and five pixels a radius: 0.5 % and 2 % of the balls' volumes between pixels.
  CHECK(seeds.volume == Approx(4 * std::numbers::pi / 3 * (1000 - 125) * std::pow(pixel, 3)).epsilon(0.01));
  for (const Vec3& x : seeds.position) REQUIRE((x - Vec3::Constant(n / 2 * pixel)).norm() > 4.8 * pixel);
}

TEST_CASE("an image is placed like other shapes, and what is wrong with it is told at its place") {
  const TemporaryFolder folder;
  folder.write("p.pgm", gray(1, 1, [](int, int) { return 1; }));
  ShapeDescription d{ImageDescription{{"p.pgm", {"s.toml", 4, 8}}, {1, 2, 3}}, {"s.toml", 3, 1}};
  d.scale = 2;
  d.rotate = {0, 0, 90};
  d.translate = {10, 0, 0};
  const auto built = [&] {
    std::vector<std::string> warnings;
    Problems problems;
    const ShapePtr shape = build_shape(d, folder.path(), kDx, warnings, problems);
    return std::pair(shape, problems.text());
  };
  const Bounds bounds = built().first->bounds();
  CHECK((bounds.min - Vec3(6, 0, 0)).norm() < 1e-12);  // rounding
  CHECK((bounds.max - Vec3(10, 2, 6)).norm() < 1e-12);
  d.kind = ImageDescription{{"none.pgm", {"s.toml", 4, 8}}, {1, 2, 3}};
  CHECK_THAT(built().second, Contains("s.toml:4:8: shape.file: ") && Contains("none.pgm': no such file"));
  d.kind = ImageDescription{{"p.pgm", {}}, {1, -2, 3}};
  CHECK(built().second == "s.toml:3:1: shape.size: must be finite and greater than 0 along each axis");
  d.kind = ImageDescription{{"p.##.pgm", {}}, {1, 2, 0}};
  CHECK_THAT(built().second, Contains("shape.size: "));
}
