// Points and inverse checks for tests of shapes.
#pragma once

#include <random>
#include <vector>

#include "engine/shapes/shape.h"

namespace firn::test {

inline double phi_at(const Shape& shape, const Vec3& x) {
  double phi = 0;
  shape.distance({&x, 1}, {&phi, 1});
  return phi;
}

inline Vec3 gradient_at(const Shape& shape, const Vec3& x, double h) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    g[axis] = (phi_at(shape, x + h * Vec3::Unit(axis)) - phi_at(shape, x - h * Vec3::Unit(axis))) / (2 * h);
  }
  return g;
}

inline std::vector<Vec3> random_points(std::size_t n, const Vec3& low, const Vec3& high) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> points(n);
  for (Vec3& x : points) {
    for (int axis = 0; axis < 3; ++axis) x[axis] = low[axis] + unit(random) * (high[axis] - low[axis]);
  }
  return points;
}

/// The volume where phi < 0, by one random point in each of n^3 strata.
inline double counted_volume(const Shape& shape, const Vec3& low, const Vec3& high, int n) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec3 step = (high - low) / n;
  std::size_t inside = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vec3 u(i + unit(random), j + unit(random), k + unit(random));
        inside += phi_at(shape, low + u.cwiseProduct(step)) < 0;
      }
  return static_cast<double>(inside) * step.prod();
}

}  // namespace firn::test
