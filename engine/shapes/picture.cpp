#include "engine/shapes/picture.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/shapes/file_bytes.h"

namespace firn {
namespace {

Picture decode(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels) {
  constexpr std::uint8_t png[] = {0x89, 'P', 'N', 'G'};
  if (bytes.size() >= 4 && std::equal(std::begin(png), std::end(png), bytes.begin()))
    return detail::decode_png(bytes, most_pixels);
  if (bytes.size() >= 2 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5'))
    return detail::decode_pgm(bytes, most_pixels);
  throw Error(ExitCode::input, "is not a picture that can be read here; allowed: PNG, or PGM (P2 or P5)");
}

}  // namespace

Picture read_picture(const std::filesystem::path& file, std::uint64_t most_pixels) {
  const std::vector<std::uint8_t> bytes = read_regular_file(file);
  try {
    return decode(bytes, most_pixels);
  } catch (const Error& error) {
    throw Error(error.code(), quoted(file) + ": " + error.what());
  }
}

void detail::check_picture_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels) {
  if (width == 0 || height == 0)
    throw Error(ExitCode::input, fmt::format("has {} x {} pixels; allowed: at least one", width, height));
  if (width <= most_pixels / height) return;
  throw Error(ExitCode::input, fmt::format("has {} x {} pixels; allowed: at most {}; scale it down", width,
                                           height, most_pixels));
}

}  // namespace firn
