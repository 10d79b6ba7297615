#include "engine/shapes/image.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/shapes/combination.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/primitives.h"
#include "engine/shapes/surface_distance.h"

namespace firn {
namespace {

/// A value this close to the threshold is at it: well below a step of 16 bits, well above float's rounding.
constexpr double kAtThreshold = 1e-6;

/// Threshold and values as a field that is negative where solid and nowhere 0.
std::vector<float> solid_field(const Raster& raster, double threshold, SolidPixels solid) {
  std::vector<float> field(raster.value.size());
  std::transform(raster.value.begin(), raster.value.end(), field.begin(), [&](float value) {
    const double f = solid == SolidPixels::bright ? threshold - value : value - threshold;
    return static_cast<float>(std::abs(f) < kAtThreshold ? -kAtThreshold : f);
  });
  return field;
}

/// The solid without the box: beyond its rim the values go on as they are there.
class ImageField final : public Shape {
 public:
  ImageField(const Raster& raster, const Bounds& box, std::vector<float> field)
      : lattice_(lattice_of(raster, box)), low_(box.min), field_(std::move(field)) {
    distance_ = distances_to_surface(lattice_, field_);
    // Solid everywhere: no distance to the rim is larger.
    const auto most = static_cast<float>((box.max - box.min).norm());
    for (float& d : distance_) d = std::min(d, most);
    bounds_ = bounds_of_solid();
  }

  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    for (std::size_t i = 0; i < points.size(); ++i) phi[i] = sample(points[i]);
  }
  Bounds bounds() const override { return bounds_; }

 private:
  static Lattice lattice_of(const Raster& raster, const Bounds& box) {
    Lattice lattice{raster.count, box.max - box.min};
    for (std::size_t axis = 0; axis < 3; ++axis)
      lattice.edge[static_cast<Eigen::Index>(axis)] /= static_cast<double>(raster.count[axis]);
    return lattice;
  }

  /// The node below a point along an axis, and how far the point is on the way to the next.
  struct Between {
    std::size_t node;
    double part;
  };

  Between between(const Vec3& x, std::size_t axis) const {
    const auto a = static_cast<Eigen::Index>(axis);
    const std::size_t n = lattice_.count[axis];
    if (n == 1) return {0, 0};
    const double u = (x[a] - low_[a]) / lattice_.edge[a] - 0.5;
    const double inside = u > 0 ? std::min(u, static_cast<double>(n - 1)) : 0;  // 0 for NaN, too
    const std::size_t node = std::min(static_cast<std::size_t>(inside), n - 2);
    return {node, inside - static_cast<double>(node)};
  }

  /// Interpolated distances alone would round off what is a pixel thin, and interpolated values have no size.
  /// So phi is the values times the interpolated ratio of distance to value: exact at the nodes, and where
  /// the surface is straight. No more than the interpolated distance, for the ratio is wild at values that
  /// come close to the threshold without crossing it.
  double sample(const Vec3& x) const {
    const std::array<Between, 3> at{between(x, 0), between(x, 1), between(x, 2)};
    double value = 0, distance = 0, ratio = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::size_t node = 0, stride = 1;
      for (std::size_t axis = 0; axis < 3; stride *= lattice_.count[axis++]) {
        const bool next = (corner >> axis) & 1;
        weight *= next ? at[axis].part : 1 - at[axis].part;
        node += stride * (at[axis].node + next);
      }
      if (weight == 0) continue;  // also what is beyond the last node
      value += weight * field_[node];
      distance += weight * distance_[node];
      ratio += weight * distance_[node] / std::abs(field_[node]);
    }
    const double size = std::min(std::abs(value) * ratio, distance);
    return value <= 0 ? -size : size;
  }

  Bounds bounds_of_solid() const {
    constexpr double inf = std::numeric_limits<double>::infinity();
    Bounds nodes{Vec3::Constant(inf), Vec3::Constant(-inf)};
    const auto [nx, ny, nz] = lattice_.count;
    for (std::size_t i = 0; i < field_.size(); ++i) {
      if (field_[i] > 0) continue;
      const Vec3 node = Eigen::Matrix<std::size_t, 3, 1>(i % nx, i / nx % ny, i / nx / ny).cast<double>();
      nodes.min = nodes.min.cwiseMin(node);
      nodes.max = nodes.max.cwiseMax(node);
    }
    // Out to the next middles, and so past the rim where the pixels at it are solid.
    Bounds bounds{low_ + lattice_.edge.cwiseProduct(nodes.min - Vec3::Constant(0.5)),
                  low_ + lattice_.edge.cwiseProduct(nodes.max + Vec3::Constant(1.5))};
    return bounds;
  }

  Lattice lattice_;
  Vec3 low_;
  std::vector<float> field_, distance_;
  Bounds bounds_;
};

void check_not_empty(const Raster& raster, const std::vector<float>& field, double threshold,
                     SolidPixels solid) {
  if (std::any_of(field.begin(), field.end(), [](float f) { return f < 0; })) return;
  const auto [least, most] = std::minmax_element(raster.value.begin(), raster.value.end());
  throw Error(
      ExitCode::input,
      fmt::format("no pixel is solid: the values reach from {:.4g} to {:.4g}, and solid "
                  "is what is {} the threshold, {:.4g}",
                  *least, *most, solid == SolidPixels::bright ? "at or above" : "at or below", threshold));
}

}  // namespace

ShapePtr make_image(const Raster& raster, const Bounds& box, double threshold, SolidPixels solid) {
  std::vector<float> field = solid_field(raster, threshold, solid);
  check_not_empty(raster, field, threshold, solid);
  return make_intersection(
      {make_box(box.min, box.max), std::make_shared<ImageField>(raster, box, std::move(field))});
}

ShapePtr read_image(const std::filesystem::path& file, const Bounds& box, double threshold,
                    SolidPixels solid) {
  const Raster raster = read_raster(file);
  try {
    return make_image(raster, box, threshold, solid);
  } catch (const Error& error) {
    throw Error(error.code(), quoted(file) + ": " + error.what());
  }
}

}  // namespace firn
