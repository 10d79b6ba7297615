// PGM as netpbm's pgm(5) has it, strictly: one picture, no value above its maximum, nothing after it.
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/shapes/picture.h"

namespace firn {
namespace {

[[noreturn]] void fail(const std::string& why) {
  throw Error(ExitCode::input, why);
}

class Pgm {
 public:
  explicit Pgm(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  Picture read(std::uint64_t most_pixels) {
    const bool plain = bytes_[1] == '2';
    at_ = 2;
    Picture picture;
    picture.width = number("its width");
    picture.height = number("its height");
    detail::check_picture_size(picture.width, picture.height, most_pixels);
    most_ = number("its largest value");
    if (most_ < 1 || most_ > 65535) fail(fmt::format("has the largest value {}; allowed: 1 to 65535", most_));
    plain ? read_plain(picture) : read_raw(picture);
    return picture;
  }

 private:
  bool at_end() const { return at_ == bytes_.size(); }

  static bool is_space(std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  void skip_blanks() {
    while (!at_end()) {
      if (bytes_[at_] == '#') {
        while (!at_end() && bytes_[at_] != '\n') ++at_;
      } else if (is_space(bytes_[at_])) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::uint64_t number(const char* what) {
    skip_blanks();
    if (at_end()) fail(fmt::format("ends before {}", what));
    std::uint64_t value = 0;
    const std::size_t begin = at_;
    for (; !at_end() && bytes_[at_] >= '0' && bytes_[at_] <= '9'; ++at_) {
      value = 10 * value + (bytes_[at_] - std::uint64_t{'0'});
      if (value > std::numeric_limits<std::uint32_t>::max())
        fail(fmt::format("{} has too many digits", what));
    }
    if (at_ == begin || !(at_end() || is_space(bytes_[at_]) || bytes_[at_] == '#'))
      fail(fmt::format("has no number at byte {}, where {} should stand", at_, what));
    return value;
  }

  float part(std::uint64_t value) const {
    if (value > most_) fail(fmt::format("has the value {}, more than its largest, {}", value, most_));
    return static_cast<float>(static_cast<double>(value) / static_cast<double>(most_));
  }

  void read_plain(Picture& picture) {
    const std::uint64_t pixels = picture.width * picture.height;
    // Each takes a digit and a blank: what is announced and cannot be there is not made room for.
    if (pixels > (bytes_.size() - at_) / 2 + 1) fail("ends before its last pixel");
    picture.value.reserve(pixels);
    for (std::uint64_t i = 0; i < pixels; ++i) picture.value.push_back(part(number("its last pixel")));
    skip_blanks();
    if (!at_end()) fail("goes on after its last pixel");
  }

  void read_raw(Picture& picture) {
    const std::uint64_t pixels = picture.width * picture.height, width = most_ > 255 ? 2 : 1;
    if (at_end() || !is_space(bytes_[at_])) fail("has no blank between its header and its pixels");
    ++at_;
    const std::uint64_t left = bytes_.size() - at_;
    if (left < pixels * width) fail("ends before its last pixel");
    if (left > pixels * width) fail("goes on after its last pixel");
    picture.value.reserve(pixels);
    for (; !at_end(); at_ += width) {
      const std::uint64_t high = bytes_[at_];
      picture.value.push_back(part(width == 1 ? high : 256 * high + bytes_[at_ + 1]));
    }
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  std::uint64_t most_ = 0;
};

}  // namespace

Picture detail::decode_pgm(std::span<const std::uint8_t> bytes, std::uint64_t most_pixels) {
  return Pgm(bytes).read(most_pixels);
}

}  // namespace firn
