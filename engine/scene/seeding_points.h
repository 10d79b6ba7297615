// Points from a file: CSV (columns by header or by place) and PLY.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/shapes/shape.h"

namespace firn {

struct PointFile {
  std::vector<Vec3> position;
  std::vector<Vec3> velocity;  // empty unless the file has it
};

/// A CSV file has columns separated by commas, semicolons, blanks or tabs. With a header they are found by
/// the names x, y, z, vx, vy, vz (others are skipped); without one there are D or 3 for the position, or
/// twice as many with the velocity. Lines that start with # are skipped. In D dimensions the coordinates
/// after the first D may be left out and must be 0. Throws Error{input} "<file>:<line>: ...".
PointFile read_point_file(const std::filesystem::path& file, int dimension);

}  // namespace firn
