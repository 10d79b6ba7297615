#include "engine/shapes/transformed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace firn {
namespace {

class Transformed final : public Shape {
 public:
  Transformed(ShapePtr shape, double scale, const Eigen::Matrix3d& rotation, const Vec3& translation)
      : shape_(std::move(shape)), scale_(scale), rotation_(rotation), translation_(translation) {}

  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    constexpr std::size_t piece = 64;
    std::array<Vec3, piece> local;
    for (std::size_t begin = 0; begin < points.size(); begin += piece) {
      const std::size_t n = std::min(piece, points.size() - begin);
      for (std::size_t i = 0; i < n; ++i) {
        local[i] = rotation_.transpose() * (points[begin + i] - translation_) / scale_;
      }
      const auto out = phi.subspan(begin, n);
      shape_->distance(std::span(local).first(n), out);
      for (double& d : out) d *= scale_;
    }
  }

  Bounds bounds() const override {
    const Bounds inner = shape_->bounds();
    if (inner.empty()) return inner;
    if (!inner.min.allFinite() || !inner.max.allFinite()) {
      const Vec3 everywhere = Vec3::Constant(std::numeric_limits<double>::infinity());
      return {-everywhere, everywhere};
    }
    const Vec3 center = scale_ * (rotation_ * (0.5 * (inner.min + inner.max))) + translation_;
    const Vec3 half = scale_ * (rotation_.cwiseAbs() * (0.5 * (inner.max - inner.min)));
    return {center - half, center + half};
  }

  std::optional<double> volume() const override {
    const std::optional<double> inner = shape_->volume();
    if (!inner) return std::nullopt;
    return *inner * scale_ * scale_ * scale_;
  }

 private:
  ShapePtr shape_;
  double scale_;
  Eigen::Matrix3d rotation_;
  Vec3 translation_;
};

Eigen::Matrix3d rotation_about(int axis, double degrees) {
  double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
  if (std::fmod(degrees, 90) == 0) {
    // Quarter turns without rounding, so that a box stays aligned with the grid.
    c = std::round(c);
    s = std::round(s);
  }
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  r(u, u) = r(v, v) = c;
  r(v, u) = s;
  r(u, v) = -s;
  return r;
}

}  // namespace

Eigen::Matrix3d rotation_xyz(const Vec3& degrees) {
  return rotation_about(2, degrees.z()) * rotation_about(1, degrees.y()) * rotation_about(0, degrees.x());
}

ShapePtr make_transformed(ShapePtr shape, double scale, const Vec3& rotate, const Vec3& translate) {
  if (scale == 1 && rotate.isZero(0) && translate.isZero(0)) return shape;
  return std::make_shared<Transformed>(std::move(shape), scale, rotation_xyz(rotate), translate);
}

}  // namespace firn
