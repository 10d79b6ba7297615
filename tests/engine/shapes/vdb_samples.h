// .vdb files for tests. Plain header; vdb_samples.cpp sees OpenVDB.
#pragma once

#include <filesystem>

#include "engine/shapes/shape.h"

namespace firn::test {

/// Writes a file with, in this order: fog volume "fog", level sets "sphere" (of `radius` about `center`) and
/// "stretched" (voxels that are not cubes), and "void" without any voxel.
void write_vdb_samples(const std::filesystem::path& file, double radius, const Vec3& center, double voxel);

/// Writes a file with, in this order, under voxels of `voxel`: "heat", of no class; fog volumes "ball" (1
/// between the radii 0.2 and 0.5, 0 elsewhere, over four voxels from one to the other), "block" (3 in a box
/// of 40 x 24 x 8 voxels from the origin on, as tiles where OpenVDB can), "endless" (0.7 everywhere but in a
/// few voxels), "vast" (six tiles of 4096 voxels, apart) and "broken" (NaN in a voxel).
void write_fog_samples(const std::filesystem::path& file, double voxel);

}  // namespace firn::test
