// One frame as an OpenVDB point grid, the cache that renderers and other tools open.
//
// The file holds one point grid, "points". Its attributes:
//   P        position, m. Stored as three 32-bit floats from the centre of the point's voxel, in voxels, so
//   it reads
//            back to within voxel_size / 2^25 (3e-8 of a voxel), whatever the distance from the origin, plus
//            the rounding of whoever reads it as float.
//   id       64-bit integer, the same for a particle in every frame. Points are stored voxel by voxel: match
//   by id. others   as FrameView names them: 1 component as float, 3 as vec3s, 9 as mat3s with m(row, column)
//   = F_row,column
//            and m * v = F v. (OpenVDB's Mat3::transform(v) is v * m, the transpose.) `material`, a whole
//            number, as int32. An attribute with one value for all points of a leaf takes no room.
// File metadata: creator, frame (int32), time (double, s), frame_rate (double, 1/s).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/particles/frame_view.h"

namespace firn {

struct PointCacheSettings {
  /// m. The simulation's cell size is a good choice: 8 particles a voxel fill a leaf of 8^3 voxels with 4096.
  double voxel_size = 0;
  double frame_rate = 24;  // 1/s
  std::string creator;     // program and version, as in "firn 0.1.0"
};

/// "particles.0001.vdb": at least four digits, so that names sort by frame.
std::string point_cache_name(int frame);

/// Writes `frame` through a CheckedFile and returns the size of the file.
/// Throws Error{ExitCode::io}, and Error{ExitCode::numerics} when a position is not finite, lies outside what
/// a grid can index (2^30 voxels from the origin), or particles are scattered so thinly that the grid would
/// fill the memory. The frame's copy functions are called from several threads at once.
std::uint64_t write_point_cache(const std::filesystem::path& file, const FrameView& frame,
                                const PointCacheSettings& settings);

}  // namespace firn
