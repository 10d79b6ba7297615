// Fog volumes as solids.
#include <cmath>
#include <fstream>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/shapes/level_set.h"
#include "tests/engine/shapes/mesh_samples.h"
#include "tests/engine/shapes/sampling.h"
#include "tests/engine/shapes/vdb_samples.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

constexpr double kVoxel = 0.025;

std::filesystem::path samples(const TemporaryFolder& folder, double voxel = kVoxel) {
  write_fog_samples(folder.path() / "f.vdb", voxel);
  return folder.path() / "f.vdb";
}

std::string failure(const std::filesystem::path& file, const std::string& grid,
                    std::optional<double> threshold) {
  try {
    read_level_set(file, grid, threshold);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::input);
    const std::string text = error.what();
    return text.substr(text.find("': ") + 3);
  }
  return "no error";
}

}  // namespace

TEST_CASE("a fog volume is solid where it is dense, and a closed pore in it stays open") {
  const TemporaryFolder folder;
  const auto file = samples(folder);
  for (const std::string grid : {"", "ball"}) {
    for (const double threshold : {0.25, 0.5, 0.75}) {
      const ShapePtr shape = read_level_set(file, grid, threshold);
      // The density falls by a quarter a voxel.
      const double shift = (0.5 - threshold) * 4 * kVoxel, outer = 0.5 + shift, inner = 0.2 - shift;
      CHECK(*shape->volume() ==
            Approx(4 * std::numbers::pi / 3 * (std::pow(outer, 3) - std::pow(inner, 3))).epsilon(0.01));
      for (const Vec3& x : random_points(3000, Vec3::Constant(-0.6), Vec3::Constant(0.6))) {
        const double exact = std::max(x.norm() - outer, inner - x.norm());
        // Facets of a voxel's size, and voxels between which distances are interpolated: a twelfth each.
        if (std::abs(exact) < 1.5 * kVoxel)
          CHECK(phi_at(*shape, x) == Approx(exact).margin(0.15 * kVoxel));
        else
          CHECK((phi_at(*shape, x) < 0) == (exact < 0));
      }
    }
  }
}

TEST_CASE("without a threshold half density is the surface of a fog volume") {
  const TemporaryFolder folder;
  const auto file = samples(folder);
  CHECK(*read_level_set(file, "ball")->volume() == *read_level_set(file, "ball", 0.5)->volume());
  CHECK(*read_level_set(file, "")->volume() == *read_level_set(file, "ball", 0.5)->volume());
}

TEST_CASE("a fog volume with tiles is solid in them, up to the voxels around") {
  const TemporaryFolder folder;
  const ShapePtr shape = read_level_set(samples(folder), "block", 1.5);
  // Voxels stand at their indices: half way from the last at 3 to the next at 0 is half a voxel out.
  const Vec3 low = Vec3::Constant(-0.5 * kVoxel), high = Vec3(39.5, 23.5, 7.5) * kVoxel;
  CHECK(*shape->volume() == Approx((high - low).prod()).epsilon(0.02));  // edges are rounded by half a voxel
  for (const Vec3& x : random_points(3000, low - Vec3::Constant(0.1), high + Vec3::Constant(0.1))) {
    const Vec3 q = (x - 0.5 * (low + high)).cwiseAbs() - 0.5 * (high - low);
    if (std::abs(q.maxCoeff()) > 0.5 * kVoxel) CHECK((phi_at(*shape, x) < 0) == (q.maxCoeff() < 0));
  }
}

TEST_CASE("a fog volume that cannot be a solid is refused with the reason") {
  const TemporaryFolder folder;
  const auto file = samples(folder), level_sets = folder.path() / "s.vdb";
  write_vdb_samples(level_sets, 0.5, Vec3::Zero(), 0.1);
  CHECK(failure(file, "ball", 2) ==
        "the fog volume's densest voxel has 1; allowed: a threshold up to there, not 2");
  CHECK(failure(file, "endless", 0.5) ==
        "the fog volume's background of 0.699999988079071 is not below the threshold, 0.5; it has no end");
  CHECK_THAT(failure(file, "vast", 0.5), Contains("its tiles alone have a surface of 603979776 voxels"));
  CHECK(failure(file, "broken", 0.5) == "holds a density that is not finite");
  CHECK(failure(file, "heat", 0.5) ==
        "grid 'heat' is a Tree_float_5_4_3 of class 'unknown', not a float level set or fog volume; convert "
        "it to "
        "one");
  CHECK(failure(level_sets, "sphere", 0.5) == "is a level set; allowed: a threshold for a fog volume only");
  CHECK(failure(level_sets, "", 0.5) == "the fog volume is empty");
  CHECK(failure(level_sets, "", {}) == "no error");
}

TEST_CASE("a damaged fog volume never takes the program down") {
  const TemporaryFolder folder;
  std::ifstream stream(samples(folder, 4 * kVoxel), std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(stream)), {});
  for (std::size_t n = 7; n < whole.size(); n += whole.size() / 60) {
    failure(folder.write("cut.vdb", whole.substr(0, n)), "ball", 0.5);
    std::string changed = whole;
    changed[n] = static_cast<char>(changed[n] ^ 0x41);
    failure(folder.write("changed.vdb", changed), "block", 0.5);
    failure(folder.write("changed.vdb", changed), "ball", 0.5);
  }
}
