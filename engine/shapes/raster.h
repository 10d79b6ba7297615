// Values on the pixels of a picture, or of a stack of them.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace firn {

/// Along x, y and z; a single picture has one pixel along z, and is the same everywhere along it.
struct Raster {
  std::array<std::size_t, 3> count{};
  std::vector<float> value;  // x fastest, then y (up), then z
};

/// Whether the file's name is one of a stack: a run of '#' stands for the number of a slice.
bool names_a_stack(const std::filesystem::path& file);

/// The picture, or for a name like "slice.####.png" all slices of that name in its folder, by number: of at
/// least as many digits as the run has '#', with zeros in front up to there. They start at any number; none
/// may be missing after that, and all have the same size. Throws Error{input}.
Raster read_raster(const std::filesystem::path& file);

}  // namespace firn
