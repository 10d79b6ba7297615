// A solid body as a signed distance: what particles are seeded from and what they collide with.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace firn {

using Vec3 = Eigen::Vector3d;

struct Bounds {
  Vec3 min = Vec3::Constant(1), max = Vec3::Constant(-1);  // empty; infinite for a plane
  bool empty() const { return (min.array() > max.array()).any(); }
};

/// `b` along the first `dimension` axes; the others are zero.
inline Bounds along_axes(Bounds b, int dimension) {
  for (int d = dimension; d < 3; ++d) b.min[d] = b.max[d] = 0;
  return b;
}

/// Immutable and safe to sample from several threads.
class Shape {
 public:
  virtual ~Shape() = default;

  /// phi at each point, m: negative inside. Exact for primitives; a bound with the right sign for
  /// combinations; a level set is exact in its band and clamped to the band's width outside it.
  virtual void distance(std::span<const Vec3> points, std::span<double> phi) const = 0;

  /// What holds every point with phi <= 0.
  virtual Bounds bounds() const = 0;

  /// m^3, where it is known better than by counting cells.
  virtual std::optional<double> volume() const { return std::nullopt; }
};

using ShapePtr = std::shared_ptr<const Shape>;

}  // namespace firn
