#include "engine/shapes/image.h"

#include <limits>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/shapes/primitives.h"
#include "tests/engine/shapes/mesh_samples.h"
#include "tests/engine/shapes/picture_samples.h"
#include "tests/engine/shapes/sampling.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

using Count = std::array<std::size_t, 3>;

constexpr auto kBright = SolidPixels::bright, kDark = SolidPixels::dark;

Bounds box_of(const Vec3& size) {
  return {Vec3::Zero(), size};
}

/// A raster whose values are a function of the pixels' middles, in a box of `size`.
Raster raster_of(const Count& count, const Vec3& size, const std::function<double(const Vec3&)>& value) {
  Raster raster{count, {}};
  for (std::size_t k = 0; k < count[2]; ++k)
    for (std::size_t j = 0; j < count[1]; ++j)
      for (std::size_t i = 0; i < count[0]; ++i) {
        const Vec3 x((static_cast<double>(i) + 0.5) * size.x() / static_cast<double>(count[0]),
                     (static_cast<double>(j) + 0.5) * size.y() / static_cast<double>(count[1]),
                     (static_cast<double>(k) + 0.5) * size.z() / static_cast<double>(count[2]));
        raster.value.push_back(static_cast<float>(value(x)));
      }
  return raster;
}

Raster noise(const Count& count) {
  std::mt19937_64 random(3);
  return raster_of(count, Vec3::Ones(),
                   [&](const Vec3&) { return std::uniform_real_distribution<double>(0, 1)(random); });
}

/// Linear interpolation, one axis after the other: slow, plain, and nothing of the shape's own.
double interpolated(const Raster& raster, const Vec3& size, Vec3 x) {
  std::vector<double> values(raster.value.begin(), raster.value.end());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::size_t n = raster.count[static_cast<std::size_t>(axis)];
    const double u =
        std::clamp(x[axis] / size[axis] * static_cast<double>(n) - 0.5, 0.0, static_cast<double>(n - 1));
    const auto low = static_cast<std::size_t>(u), high = std::min(low + 1, n - 1);
    const double part = u - static_cast<double>(low);
    // The axes before are gone: this one is the fastest that is left.
    std::vector<double> next;
    for (std::size_t at = 0; at < values.size(); at += n)
      next.push_back(values[at + low] * (1 - part) + values[at + high] * part);
    values = next;
  }
  return values.front();
}

std::string failure(const std::filesystem::path& file, const Vec3& size = Vec3::Ones(),
                    double threshold = 0.5, SolidPixels solid = kBright) {
  try {
    read_image(file, box_of(size), threshold, solid);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::input);
    return error.what();
  }
  return "no error";
}

std::string flat(int width, int height, double value) {
  return gray(width, height, [=](int, int) { return value; });
}

}  // namespace

TEST_CASE("an image lies as one sees it, x to the right and y up, and is the same all along z") {
  const TemporaryFolder folder;
  // Bright: the left pixel of the upper row.
  const auto file = folder.write("p.pgm", gray(3, 2, [](int i, int j) { return i == 0 && j == 0 ? 1 : 0; }));
  const ShapePtr shape = read_image(file, box_of({3, 2, 5}), 0.5, kBright);
  for (double z : {0.1, 2.5, 4.9}) {
    CHECK(phi_at(*shape, {0.5, 1.5, z}) < 0);
    CHECK(phi_at(*shape, {0.5, 0.5, z}) > 0);
    CHECK(phi_at(*shape, {2.5, 1.5, z}) > 0);
    CHECK(phi_at(*shape, {2.5, 0.5, z}) > 0);
  }
  CHECK(phi_at(*shape, {0.5, 1.5, -0.1}) > 0);
  CHECK(phi_at(*shape, {0.5, 1.5, 5.1}) > 0);
}

TEST_CASE("a stack's slices follow each other along z, in the order of their numbers") {
  const TemporaryFolder folder;
  for (int number = 8; number <= 11; ++number)  // across a change of digits
    folder.write(fmt::format("s.{:02}.pgm", number), flat(3, 3, number == 10 ? 1 : 0));
  const ShapePtr shape = read_image(folder.path() / "s.##.pgm", box_of({1, 1, 4}), 0.5, kBright);
  // The third of four slices, its middle at 2.5; half way to the next the values are 0.5.
  for (const auto& [z, phi] : {std::pair(2.5, -0.5), {2.25, -0.25}, {1.75, 0.25}, {3.5, 0.5}, {0.5, 1.5}})
    CHECK(phi_at(*shape, {0.5, 0.5, z}) == Approx(phi).margin(1e-6));  // of float
}

TEST_CASE("an image is solid where the interpolated value reaches the threshold, and nowhere else") {
  const Vec3 size(0.7, 0.5, 0.3);
  for (const Count& count : {Count{9, 7, 1}, Count{6, 5, 7}, Count{1, 8, 1}, Count{1, 1, 9}}) {
    const Raster raster = noise(count);
    for (const double threshold : {0.3, 0.5, 0.7}) {
      const ShapePtr bright = make_image(raster, box_of(size), threshold, kBright),
                     dark = make_image(raster, box_of(size), threshold, kDark);
      for (const Vec3& x : random_points(3000, Vec3::Zero(), size)) {
        const double value = interpolated(raster, size, x);
        if (std::abs(value - threshold) < 1e-5) continue;  // values at the threshold are solid within 1e-6
        REQUIRE((phi_at(*bright, x) < 0) == (value > threshold));
        REQUIRE((phi_at(*dark, x) < 0) == (value < threshold));
      }
    }
  }
}

TEST_CASE("a value at the threshold is solid, bright or dark") {
  for (const SolidPixels solid : {kBright, kDark}) {
    for (int v : {51, 102, 204}) {
      const Raster raster{{1, 1, 1}, {static_cast<float>(v / 255.0)}};
      CHECK(phi_at(*make_image(raster, box_of(Vec3::Ones()), v / 255.0, solid), Vec3::Constant(0.5)) < 0);
    }
  }
}

TEST_CASE("an image that is solid everywhere is its box") {
  const Vec3 size(2, 1, 3);
  const ShapePtr box = make_box(Vec3::Zero(), size);
  for (const Count& count : {Count{1, 1, 1}, Count{5, 4, 1}, Count{3, 4, 5}}) {
    const ShapePtr image =
        make_image(raster_of(count, size, [](const Vec3&) { return 1; }), box_of(size), 0.5, kBright);
    for (const Vec3& x : random_points(500, -size, 2 * size)) CHECK(phi_at(*image, x) == phi_at(*box, x));
    CHECK(image->bounds().min == Vec3::Zero());
    CHECK(image->bounds().max == size);
  }
}

TEST_CASE("an edge between black and white has its distance on both sides, across pixels of any shape") {
  const Vec3 size(4, 8, 1);
  // White from x = 2 on, in pixels 1/5 by 2: the edge is between the middles, where pixels meet.
  const ShapePtr shape = make_image(raster_of({20, 4, 1}, size, [](const Vec3& x) { return x.x() > 2; }),
                                    {{0, 0, -1e3}, {4, 8, 1e3}}, 0.5, kBright);
  for (const Vec3& x : random_points(500, {0.2, 0, -1}, {3, 8, 1})) {
    const double exact = std::max({2 - x.x(), -x.y(), x.y() - 8});
    CHECK(phi_at(*shape, x) == Approx(exact).margin(1e-5));  // of float, with distances of 2
  }
}

TEST_CASE("the distance to a disc drawn with soft rims is the disc's to a quarter of a pixel") {
  double last = 1;
  for (const std::size_t n : {20, 40, 80}) {
    const double pixel = 1.0 / static_cast<double>(n);
    const auto exact = [](const Vec3& x) { return std::hypot(x.x() - 0.5, x.y() - 0.5) - 0.3; };
    const auto soft = [&](const Vec3& x) { return std::clamp(0.5 - exact(x) / pixel / 2, 0.0, 1.0); };
    const ShapePtr shape =
        make_image(raster_of({n, n, 1}, Vec3::Ones(), soft), {{0, 0, -10}, {1, 1, 10}}, 0.5, kBright);
    double worst = 0, worst_beyond = 0;
    for (const Vec3& x : random_points(5000, Vec3::Zero(), {1, 1, 0})) {
      const double phi = phi_at(*shape, x), error = std::abs(phi - exact(x));
      // The box about the picture is nearer than the disc only close to it.
      if (std::abs(exact(x)) < 1.5 * pixel) worst = std::max(worst, error);
      worst_beyond = std::max(worst_beyond, std::abs(phi) - std::abs(exact(x)));
    }
    // Values that are cut off at 0 and 1 bend the interpolated edge by up to a fifth of a pixel.
    CHECK(worst < 0.25 * pixel);
    CHECK(worst_beyond < 0.15 * pixel);  // seeding counts on phi not being too large
    CHECK(worst < last);
    last = worst;
  }
}

TEST_CASE("an image's distance exceeds that to the other side by less than a quarter of a pixel") {
  for (const Count& count : {Count{12, 12, 1}, Count{8, 8, 8}}) {
    const double depth = count[2] == 1 ? 0 : 1;
    const Bounds box = depth == 0 ? Bounds{{0, 0, -10}, {1, 1, 10}} : box_of(Vec3::Ones());
    const ShapePtr shape = make_image(noise(count), box, 0.6, kBright);
    const auto points = random_points(2000, Vec3::Zero(), {1, 1, depth});
    std::vector<double> phi(points.size());
    shape->distance(points, phi);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (phi[i] >= 0) continue;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (phi[j] > 0) worst = std::max(worst, std::max(phi[j], -phi[i]) - (points[i] - points[j]).norm());
      }
    }
    CHECK(worst < 0.25 / static_cast<double>(count[0]));
  }
}

TEST_CASE("points far away, infinite or undefined are outside an image, or at its rim") {
  const ShapePtr shape = make_image(noise({5, 5, 5}), box_of(Vec3::Ones()), 0.5, kBright);
  const double inf = std::numeric_limits<double>::infinity();
  for (double c : {100.0, -1e10, 1e300, inf, -inf}) {
    CHECK(phi_at(*shape, {c, 0.5, 0.5}) > 0);
    CHECK(phi_at(*shape, {0.5, 0.5, c}) > 0);
  }
}

TEST_CASE("an image's bounds hold all that is solid") {
  for (const Count& count : {Count{12, 9, 1}, Count{6, 7, 8}}) {
    const ShapePtr shape = make_image(noise(count), box_of(Vec3::Ones()), 0.97, kBright);
    const Bounds bounds = shape->bounds();
    for (const Vec3& x : random_points(20000, Vec3::Constant(-0.1), Vec3::Constant(1.1))) {
      if (phi_at(*shape, x) > 0) continue;
      REQUIRE((x.array() >= bounds.min.array()).all());
      REQUIRE((x.array() <= bounds.max.array()).all());
    }
  }
}

TEST_CASE("a stack with a gap, slices of different size or none at all is refused with the slice's name") {
  const TemporaryFolder folder;
  const std::string at = "'" + (folder.path() / "s.###.pgm").string() + "': ";
  CHECK(failure(folder.path() / "s.###.pgm") ==
        at + "no file of that name with a number for its '#', such as 's.001.pgm'");
  for (int number : {2, 3, 5, 7}) folder.write(fmt::format("s.{:03}.pgm", number), flat(2, 3, 1));
  folder.write("s.4.pgm", flat(2, 3, 1));     // too few digits
  folder.write("s.0004.pgm", flat(2, 3, 1));  // zeros that its width does not call for
  folder.write("s.004.pgm~", flat(2, 3, 1));
  CHECK(failure(folder.path() / "s.###.pgm") ==
        at + "'s.004.pgm' is missing, between 3 and 5; allowed: slices without a gap");
  folder.write("s.004.pgm", flat(2, 3, 1));
  folder.write("s.006.pgm", flat(3, 2, 1));
  CHECK(failure(folder.path() / "s.###.pgm") ==
        "'" + (folder.path() / "s.006.pgm").string() +
            "': has 3 x 2 pixels; allowed: 2 x 3, which the first slice, 's.002.pgm', has");
  folder.write("s.006.pgm", "P5 2 3 255\n");
  CHECK_THAT(failure(folder.path() / "s.###.pgm"), Contains("s.006.pgm': ends before its last pixel"));
  CHECK_THAT(failure(folder.path() / "s.#.#.pgm"), Contains("has several runs of '#'"));
  CHECK_THAT(failure(folder.path() / "no" / "s.#.pgm"), Contains("no': No such file or directory"));
}

TEST_CASE("the slices of a stack share the limit of pixels") {
  const TemporaryFolder folder;
  for (int number : {1, 2, 3}) folder.write(fmt::format("s{}.pgm", number), "P5 9000 9000 255\n");
  CHECK_THAT(failure(folder.path() / "s#.pgm"),
             Contains("has 9000 x 9000 pixels; allowed: at most 44739242"));
}

TEST_CASE("an image without a solid pixel is refused with the values that it has") {
  const TemporaryFolder folder;
  const auto file = folder.write("p.pgm", pgm(2, 1, 10, [](int i, int) { return i == 0 ? 1u : 3u; }));
  const std::string at =
      "'" + file.string() + "': no pixel is solid: the values reach from 0.1 to 0.3, and solid is ";
  CHECK(failure(file) == at + "what is at or above the threshold, 0.5");
  CHECK(failure(file, Vec3::Ones(), 0.05, kDark) == at + "what is at or below the threshold, 0.05");
  CHECK(failure("/nowhere.png") == "'/nowhere.png': no such file");
}
