// Particles of a disk on a lattice about its centre, as the reference figures have them.
#pragma once

#include <cmath>

#include "engine/scene/seeding.h"

namespace firn::test {

/// `spacing` m apart, each with a square of that edge; `velocity`: m/s, of a place relative to the centre.
template <class Velocity>
Seeds lattice_disk(const Vec3& center, double radius, double spacing, Velocity&& velocity) {
  Seeds out;
  const int n = static_cast<int>(std::ceil(radius / spacing));
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j) {
      const Vec3 offset = spacing * Vec3(i + 0.5, j + 0.5, 0);
      if (offset.norm() > radius) continue;
      out.position.push_back(center + offset);
      out.velocity.push_back(velocity(offset));
    }
  out.volume = spacing * spacing * static_cast<double>(out.position.size());
  return out;
}

}  // namespace firn::test
