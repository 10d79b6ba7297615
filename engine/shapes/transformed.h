// A shape scaled, turned and moved. Scale is uniform, so distances stay exact.
#pragma once

#include <Eigen/Geometry>

#include "engine/shapes/shape.h"

namespace firn {

/// The rotation about the fixed x, then y, then z axis, each in degrees.
Eigen::Matrix3d rotation_xyz(const Vec3& degrees);

/// x -> rotation_xyz(rotate) * (scale * x) + translate, with scale > 0.
ShapePtr make_transformed(ShapePtr shape, double scale, const Vec3& rotate, const Vec3& translate);

}  // namespace firn
