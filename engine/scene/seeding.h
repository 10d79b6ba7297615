// Particles of a body: where they start, and how much volume they share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/description.h"
#include "engine/shapes/shape.h"

namespace firn {

struct Seeds {
  std::vector<Vec3> position;
  std::vector<Vec3> velocity;  // empty unless the body's point file has velocities
  double volume = 0;           // m^dimension of the whole body; each particle has volume / position.size()
};

/// The body's particles. In 3D the volume is the shape's own where it knows it, else it is sampled; for a
/// point file it is count * cell_size^D / particles_per_cell. Depends on the arguments only, not on threads.
/// `shape` is what build_shape made of body.shape, null for a point file. Throws Error{input}: no particle in
/// the shape, a bad point file; Error{resources}: more particles than can be held. What is doubtful goes to
/// `warnings`.
Seeds seed_body(const BodyDescription& body, const Shape* shape, int dimension, double cell_size,
                std::uint64_t seed, std::size_t body_index, const std::filesystem::path& scene_folder,
                std::vector<std::string>& warnings);

/// About how many particles seed_body will make, without making them.
double estimate_count(const BodyDescription& body, const Shape* shape, int dimension, double cell_size,
                      const std::filesystem::path& scene_folder);

}  // namespace firn
