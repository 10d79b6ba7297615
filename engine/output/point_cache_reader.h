// What a point cache holds. OpenVDB believes what a file says of itself, so that a damaged one may crash it
// or keep it busy for ever: a child process reads, and hands over plain numbers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace firn {

struct ComponentRange {
  double min = 0, mean = 0, max = 0;
};

struct PointAttribute {
  std::string name, type;  // as the file says: "float", "vec3s", "mat3s", "int64", ...
  /// Of the values that are finite; matrices row by row. Empty for a type that has no numbers, and where no
  /// particle has a finite value.
  std::vector<ComponentRange> ranges;
  std::size_t not_finite = 0;  // particles with a component that is not
};

struct PointCacheSummary {
  std::size_t particles = 0;
  double voxel_size = 0;                   // m
  std::vector<PointAttribute> attributes;  // in the order of the file
  // What Firn writes into each frame and others may not.
  std::string creator;
  std::optional<int> frame;
  std::optional<double> time, frame_rate;
};

/// One attribute of all particles, `components` numbers each, in the order of the file. `P` is in metres.
struct PointColumn {
  std::string name, type;
  std::size_t components = 0;
  std::vector<double> values;  // exact: floats, and integers below 2^53
};

/// Throws Error{ExitCode::input} for a file that is missing, damaged or without points.
PointCacheSummary summarize_point_cache(const std::filesystem::path& file);

/// The attributes of these names, in this order. Throws Error{ExitCode::input}, too, for a name that the
/// cache does not have, with the ones that it has and the nearest.
std::vector<PointColumn> read_point_columns(const std::filesystem::path& file,
                                            const std::vector<std::string>& names);

}  // namespace firn
