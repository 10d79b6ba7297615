#include "engine/scene/seeding.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/problems.h"
#include "engine/scene/build_shape.h"
#include "engine/scene/seeding_cells.h"
#include "engine/scene/seeding_hash.h"
#include "engine/scene/seeding_patterns.h"
#include "engine/scene/seeding_points.h"

namespace firn {
namespace {

constexpr double kMostParticles = 2147483648.0;

/// While seeding, positions exist twice: by row and together.
constexpr double kBytesPerParticle = 2 * sizeof(Vec3);

/// Relative difference between the particles and what the volume calls for that is worth a word.
constexpr double kDoubtful = 0.05;

[[noreturn]] void fail(const BodyDescription& body, ExitCode code, const std::string& why) {
  Problems problems;
  problems.add(body.mark, fmt::format("bodies.{}", body.name), why);
  throw Error(code, problems.text());
}

/// Errors of the layers below, told with the body's place in the scene.
template <class Work>
auto located(const BodyDescription& body, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    fail(body, error.code(), error.what());
  }
}

double per_volume(const BodyDescription& body, int dimension, double cell_size) {
  return body.particles_per_cell / std::pow(cell_size, dimension);
}

double exact_volume(const Shape& shape, int dimension, double cell_size) {
  if (const std::optional<double> known = shape.volume(); known && dimension == 3) return *known;
  return measure(shape, covering_cells(shape.bounds(), dimension, cell_size));
}

double rough_volume(const Shape& shape, int dimension, double cell_size) {
  if (const std::optional<double> known = shape.volume(); known && dimension == 3) return *known;
  const Bounds bounds = shape.bounds();
  if (bounds.empty()) return 0;
  double longest = 0;
  for (int axis = 0; axis < dimension; ++axis)
    longest = std::max(longest, bounds.max[axis] - bounds.min[axis]);
  return measure(shape, covering_cells(bounds, dimension, std::max(cell_size, longest / 64)));
}

double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string key;
  double kilobytes = 0;
  while (file >> key >> kilobytes) {
    if (key == "MemAvailable:") return kilobytes * 1024;
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return std::numeric_limits<double>::infinity();
}

void check_count(const BodyDescription& body, double count, int dimension, double cell_size) {
  const double most = std::min(kMostParticles, available_memory() / kBytesPerParticle);
  if (count <= most) return;
  const double larger = cell_size * std::pow(count / most, 1.0 / dimension);
  fail(body, ExitCode::resources,
       fmt::format("about {:.3g} particles, more than the {:.3g} that can be held here; choose cell_size >= "
                   "{:.3g} (now "
                   "{:.3g}) or fewer particles_per_cell (now {:.3g})",
                   count, most, larger, cell_size, body.particles_per_cell));
}

std::string why_empty(const Shape& shape, int dimension, double cell_size) {
  const Bounds b = shape.bounds();
  if (b.empty()) return "the shape is empty: its parts do not meet, or everything is subtracted";
  for (int axis = dimension; axis < 3; ++axis) {
    if (b.min[axis] > 0 || b.max[axis] < 0) {
      return fmt::format(
          "no particles: the shape reaches from {0} = {1:.4g} to {2:.4g} m, and a scene in {3} dimension{4} "
          "lies at {0} = 0",
          "xyz"[axis], b.min[axis], b.max[axis], dimension, dimension == 1 ? "" : "s");
    }
  }
  const Vec3 extent = b.max - b.min;
  return fmt::format(
      "no particles: the shape's bounding box is {:.3g} x {:.3g} x {:.3g} m and a cell is {:.3g} m; make the "
      "shape thicker than a cell, choose a smaller cell_size, or check the shape's units (scale)",
      extent.x(), extent.y(), extent.z(), cell_size);
}

Seeds seeds_from_file(const BodyDescription& body, int dimension, double cell_size,
                      const std::filesystem::path& scene_folder) {
  PointFile file = read_point_file(resolve_file(scene_folder, body.points->text), dimension);
  Seeds seeds{std::move(file.position), std::move(file.velocity)};
  seeds.volume = static_cast<double>(seeds.position.size()) / per_volume(body, dimension, cell_size);
  return seeds;
}

void compare_count(const BodyDescription& body, const Seeds& seeds, double wanted,
                   std::vector<std::string>& warnings) {
  const double count = static_cast<double>(seeds.position.size());
  // Few particles differ by chance: up to two standard deviations of as many independent ones pass.
  if (std::abs(count - wanted) <= kDoubtful * wanted + 2 * std::sqrt(wanted)) return;
  warnings.push_back(
      fmt::format("body '{}': {:.0f} particles where its volume of {:.4g} calls for {:.0f}; parts of it may "
                  "be thinner than the distance between particles",
                  body.name, count, seeds.volume, wanted));
}

PointPattern pattern_of(const BodyDescription& body, int dimension, double cell_size, std::uint64_t key) {
  const double per_cell = body.particles_per_cell;
  if (body.sampling == Sampling::poisson) return poisson_pattern(dimension, cell_size, per_cell, key);
  return jittered_pattern(dimension, cell_size, per_cell, key, body.sampling == Sampling::lattice ? 0 : 1);
}

}  // namespace

Seeds seed_body(const BodyDescription& body, const Shape* shape, int dimension, double cell_size,
                std::uint64_t seed, std::size_t body_index, const std::filesystem::path& scene_folder,
                std::vector<std::string>& warnings) {
  if (body.points) {
    return located(body, [&] { return seeds_from_file(body, dimension, cell_size, scene_folder); });
  }
  check_count(body, estimate_count(body, shape, dimension, cell_size, scene_folder), dimension, cell_size);

  const PointPattern pattern = pattern_of(body, dimension, cell_size, body_key(seed, body_index));
  Seeds seeds;
  located(body, [&] {
    seeds.position = points_inside(*shape, covering_cells(shape->bounds(), dimension, pattern.cell_size),
                                   pattern.points_of);
    seeds.volume = exact_volume(*shape, dimension, cell_size);
  });
  if (seeds.position.empty()) fail(body, ExitCode::input, why_empty(*shape, dimension, cell_size));
  compare_count(body, seeds, seeds.volume * per_volume(body, dimension, cell_size), warnings);
  return seeds;
}

double estimate_count(const BodyDescription& body, const Shape* shape, int dimension, double cell_size,
                      const std::filesystem::path& scene_folder) {
  return located(body, [&] {
    if (body.points) {
      return static_cast<double>(
          read_point_file(resolve_file(scene_folder, body.points->text), dimension).position.size());
    }
    return rough_volume(*shape, dimension, cell_size) * per_volume(body, dimension, cell_size);
  });
}

}  // namespace firn
