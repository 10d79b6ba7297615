// What a child process that reads a .vdb file hands over: numbers only, so that nothing of the file's
// structure reaches this process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace firn {

inline constexpr std::uint64_t kMostVdbLeaves = 8'000'000;  // 16 GB of values
inline constexpr std::uint64_t kMostVdbTiles = 100'000'000;

/// A header is followed by its leaves, then its tiles.
struct VdbHeader {
  double axes[9], origin[3];  // world position of index i: origin + axes * i
  double background;          // of a level set m, of a fog volume its density
  std::uint64_t leaves, tiles;
  std::uint64_t fog;  // 1 for a fog volume, 0 for a level set
};

/// 8 x 8 x 8 voxels, as OpenVDB orders them.
struct VdbLeaf {
  std::int32_t origin[3];
  float values[512];
};

/// Of a fog volume: a cube of one value; the edges are 8, 128 and 4096 voxels on the levels 1, 2, 3.
struct VdbTile {
  std::int32_t origin[3];
  std::uint32_t level;
  float value;
};

/// For the child only: grid `wanted` of a file; if empty, the first level set, or the first fog volume with
/// `fog_first` or where there is no level set. Throws Error{input} without the file's name.
std::vector<std::uint8_t> read_vdb_grid(const std::string& path, const std::string& wanted, bool fog_first);

}  // namespace firn
