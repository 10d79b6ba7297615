// A surface as vertices and triangles, in metres; what a mesh file is reduced to.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/shapes/shape.h"

namespace firn {

using Triangle = std::array<std::uint32_t, 3>;

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace firn
