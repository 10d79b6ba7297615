// .vdb files for tests. Plain header; vdb_samples.cpp sees OpenVDB.
#pragma once

#include <filesystem>

#include "engine/shapes/shape.h"

namespace firn::test {

/// Writes a file with, in this order: fog volume "fog", level sets "sphere" (of `radius` about `center`) and
/// "stretched" (voxels that are not cubes), and "void" without any voxel.
void write_vdb_samples(const std::filesystem::path& file, double radius, const Vec3& center, double voxel);

}  // namespace firn::test
