// Solids with an exact signed distance and a closed-form volume. Arguments are taken as valid (the scene
// reader and build_shape check them).
#pragma once

#include "engine/shapes/shape.h"

namespace firn {

ShapePtr make_sphere(const Vec3& center, double radius);
ShapePtr make_box(const Vec3& min, const Vec3& max);

/// The cylinder around start-end with flat ends.
ShapePtr make_cylinder(const Vec3& start, const Vec3& end, double radius);

/// The cone with a flat base of `radius` around `base`, pointed at `apex`.
ShapePtr make_cone(const Vec3& base, const Vec3& apex, double radius);

/// The half space the normal points away from. It has no bounds and no volume.
ShapePtr make_plane(const Vec3& point, const Vec3& normal);

}  // namespace firn
