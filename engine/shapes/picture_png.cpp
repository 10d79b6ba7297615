// PNG by libpng's simplified interface, which reports what is wrong instead of jumping out of this code.
#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <png.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/shapes/picture.h"

namespace firn {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void fail(const std::string& why) {
  throw Error(ExitCode::input, why);
}

/// The file without the chunks that say how a screen shows it (gAMA, sRGB, iCCP, ...): libpng would convert
/// by them, and a density would depend on which program wrote it.
Bytes without_color_space(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t signature = 8, around = 12;  // length, type and checksum about a chunk's data
  constexpr const char* truncated = "ends before its last part (IEND); the file was cut off";
  if (bytes.size() < signature) fail(truncated);
  Bytes kept(bytes.begin(), bytes.begin() + signature);
  for (std::size_t at = signature;;) {
    const auto left = bytes.subspan(at);
    if (left.size() < around) fail(truncated);
    const std::size_t length = (std::size_t{left[0]} << 24) | (std::size_t{left[1]} << 16) |
                               (std::size_t{left[2]} << 8) | std::size_t{left[3]};
    if (length > left.size() - around) fail(truncated);
    const auto is = [&](std::string_view type) {
      return std::equal(type.begin(), type.end(), left.begin() + 4);
    };
    const bool critical = (left[4] & 0x20) == 0;  // by the case of a type's first letter
    const auto chunk = left.first(length + around);
    if (critical || is("tRNS")) kept.insert(kept.end(), chunk.begin(), chunk.end());
    if (is("IEND")) return kept;
    at += chunk.size();
  }
}

/// libpng's own memory goes with it, whatever is thrown.
class Png {
 public:
  explicit Png(const Bytes& bytes) {
    image_.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&image_, bytes.data(), bytes.size())) refuse();
  }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() { png_image_free(&image_); }

  Picture read(std::uint64_t most_pixels) {
    detail::check_picture_size(image_.width, image_.height, most_pixels);
    // Each in its own depth: between them libpng would convert from sRGB's curve to linear values.
    const bool deep = (image_.format & PNG_FORMAT_FLAG_LINEAR) != 0;
    return deep ? pixels<std::uint16_t>(PNG_FORMAT_LINEAR_Y) : pixels<std::uint8_t>(PNG_FORMAT_GRAY);
  }

 private:
  template <class Value>
  Picture pixels(png_uint_32 format) {
    image_.format = format;
    std::vector<Value> values(std::size_t{image_.width} * image_.height);
    const png_color black{};
    if (!png_image_finish_read(&image_, &black, values.data(), static_cast<png_int_32>(image_.width),
                               nullptr))
      refuse();
    Picture picture{image_.width, image_.height, {}};
    picture.value.reserve(values.size());
    constexpr double full = std::numeric_limits<Value>::max();
    for (const Value v : values) picture.value.push_back(static_cast<float>(v / full));
    return picture;
  }

  [[noreturn]] void refuse() const { fail(fmt::format("is damaged: {}", printable(image_.message))); }

  png_image image_{};
};

}  // namespace

Picture detail::decode_png(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels) {
  const Bytes kept = without_color_space(bytes);
  return Png(kept).read(most_pixels);
}

}  // namespace firn
