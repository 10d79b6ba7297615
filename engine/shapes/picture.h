// Gray pictures from PNG and PGM files. What a file says is not trusted: damaged and hostile ones are
// refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace firn {

/// What a picture may have, or all slices of a stack together. Finding the distances to the surface of so
/// many takes 3 GB, or 6 if all is noise.
inline constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 27;

struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<float> value;  // 0 to 1 of the file's full range; rows from the top, each from the left
};

/// A PNG (any kind: colour becomes luminance, what is transparent is put on black) or a PGM (P2 or P5), told
/// apart by content. Throws Error{input}.
Picture read_picture(const std::filesystem::path& file, std::uint64_t most_pixels = kMostPixels);

namespace detail {
/// The readers of one format each. They throw Error{input} without the file's name.
Picture decode_pgm(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels);
Picture decode_png(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels);

/// Throws unless both are more than 0 and the picture is not too large.
void check_picture_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels);
}  // namespace detail

}  // namespace firn
