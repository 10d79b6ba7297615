#include "engine/shapes/primitives.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace firn {
namespace {

constexpr double kPi = std::numbers::pi;

/// A shape given by a function of one point.
template <class Phi>
class Primitive final : public Shape {
 public:
  Primitive(Phi phi, const Bounds& bounds, std::optional<double> volume)
      : phi_(phi), bounds_(bounds), volume_(volume) {}

  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    for (std::size_t i = 0; i < points.size(); ++i) phi[i] = phi_(points[i]);
  }
  Bounds bounds() const override { return bounds_; }
  std::optional<double> volume() const override { return volume_; }

 private:
  Phi phi_;
  Bounds bounds_;
  std::optional<double> volume_;
};

template <class Phi>
ShapePtr make_primitive(Phi phi, const Bounds& bounds, std::optional<double> volume) {
  return std::make_shared<Primitive<Phi>>(phi, bounds, volume);
}

/// Distance along and from the axis of a solid of revolution.
struct Axial {
  Vec3 origin, axis;

  struct Coordinates {
    double along, radial;
  };
  Coordinates of(const Vec3& p) const {
    const Vec3 d = p - origin;
    const double along = d.dot(axis);
    return {along, (d - along * axis).norm()};
  }
};

/// Half the box around a disc of `radius` with normal `axis`.
Vec3 disc_extent(const Vec3& axis, double radius) {
  return radius * (1 - axis.array().square()).max(0).sqrt().matrix();
}

double distance_to_segment(double x, double y, double ax, double ay, double bx, double by) {
  const double ex = bx - ax, ey = by - ay;
  const double t = std::clamp(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
  return std::hypot(x - ax - t * ex, y - ay - t * ey);
}

}  // namespace

ShapePtr make_sphere(const Vec3& center, double radius) {
  const auto phi = [=](const Vec3& p) { return (p - center).norm() - radius; };
  const Bounds bounds{center.array() - radius, center.array() + radius};
  return make_primitive(phi, bounds, 4.0 / 3.0 * kPi * radius * radius * radius);
}

ShapePtr make_box(const Vec3& min, const Vec3& max) {
  const Vec3 center = 0.5 * (min + max), half = 0.5 * (max - min);
  const auto phi = [=](const Vec3& p) {
    const Vec3 q = (p - center).cwiseAbs() - half;
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
  };
  return make_primitive(phi, Bounds{min, max}, (max - min).prod());
}

ShapePtr make_cylinder(const Vec3& start, const Vec3& end, double radius) {
  const double length = (end - start).norm();
  const Axial axial{start, (end - start) / length};
  const auto phi = [=](const Vec3& p) {
    const auto [along, radial] = axial.of(p);
    const double side = radial - radius, cap = std::abs(along - 0.5 * length) - 0.5 * length;
    return std::hypot(std::max(side, 0.0), std::max(cap, 0.0)) + std::min(std::max(side, cap), 0.0);
  };
  const Vec3 disc = disc_extent(axial.axis, radius);
  const Bounds bounds{start.cwiseMin(end) - disc, start.cwiseMax(end) + disc};
  return make_primitive(phi, bounds, kPi * radius * radius * length);
}

ShapePtr make_cone(const Vec3& base, const Vec3& apex, double radius) {
  const double height = (apex - base).norm();
  const Axial axial{base, (apex - base) / height};
  const auto phi = [=](const Vec3& p) {
    const auto [along, radial] = axial.of(p);
    const double to_base = distance_to_segment(radial, along, 0, 0, radius, 0);
    const double to_side = distance_to_segment(radial, along, radius, 0, 0, height);
    const bool inside = along >= 0 && radial * height + along * radius <= radius * height;
    return (inside ? -1 : 1) * std::min(to_base, to_side);
  };
  const Vec3 disc = disc_extent(axial.axis, radius);
  const Bounds bounds{apex.cwiseMin(base - disc), apex.cwiseMax(base + disc)};
  return make_primitive(phi, bounds, kPi / 3 * radius * radius * height);
}

ShapePtr make_plane(const Vec3& point, const Vec3& normal) {
  const Vec3 n = normal.normalized();
  const auto phi = [=](const Vec3& p) { return n.dot(p - point); };
  const Vec3 everywhere = Vec3::Constant(std::numeric_limits<double>::infinity());
  return make_primitive(phi, Bounds{-everywhere, everywhere}, std::nullopt);
}

}  // namespace firn
