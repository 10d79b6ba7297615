#include "engine/shapes/picture.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/engine/shapes/mesh_samples.h"
#include "tests/engine/shapes/picture_samples.h"

using namespace firn;
using namespace firn::test;
using Catch::Matchers::Contains;

namespace {

std::vector<float> values_of(const std::string& bytes) {
  const TemporaryFolder folder;
  return read_picture(folder.write("p", bytes)).value;
}

/// What comes after the file's name.
std::string why_not(const std::string& bytes) {
  const TemporaryFolder folder;
  try {
    read_picture(folder.write("p", bytes));
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::input);
    const std::string text = error.what(), name = (folder.path() / "p").string();
    CHECK(text.find("'" + name + "': ") == 0);
    return text.substr(name.size() + 4);
  }
  return "no error";
}

std::string all_bytes() {
  std::string all;
  for (int v = 0; v < 256; ++v) all += static_cast<char>(v);
  return all;
}

/// 1 of 256 steps: what rounding to 8 bits can do to a value.
constexpr double kStep = 1 / 255.0;

}  // namespace

TEST_CASE("a PGM's values are parts of its own largest value") {
  CHECK(values_of("P2 3 1 4 0 1 4") == std::vector<float>{0, 0.25f, 1});
  CHECK(values_of("P2#a\n# b\r\n3 #\t7\n1\n\n4#\n0\n#c\n1 4\n\n") == std::vector<float>{0, 0.25f, 1});
  CHECK(values_of(pgm(2, 1, 4, [](int i, int) { return i == 0 ? 3u : 2u; })) ==
        std::vector<float>{0.75f, 0.5f});
  const auto deep = [](int i, int) { return i == 0 ? 0x0100u : 0x0200u; };
  CHECK(values_of(pgm(2, 1, 0x400, deep)) == std::vector<float>{0.25f, 0.5f});
}

TEST_CASE("a picture's rows come from the top") {
  const TemporaryFolder folder;
  const Picture picture = read_picture(folder.write("p", "P2 2 3 9 1 2 3 4 5 6"));
  CHECK(picture.width == 2);
  CHECK(picture.height == 3);
  CHECK(picture.value[2] == 3.0f / 9);
}

TEST_CASE("a gray PNG's values are what it stores, whatever it says of screens") {
  const std::string linear = png_chunk("gAMA", bytes_of(100000, 4)),
                    srgb = png_chunk("sRGB", std::string(1, '\0'));
  for (const std::string& extra : {std::string(), linear, srgb}) {
    const std::vector<float> bytes = values_of(png(256, 1, {8, 0}, all_bytes(), extra));
    REQUIRE(bytes.size() == 256);
    for (std::size_t v = 0; v < 256; ++v) CHECK(bytes[v] == static_cast<float>(static_cast<double>(v) / 255));
    std::string words;
    for (std::uint32_t v = 0; v < 256; ++v) words += bytes_of(257 * v + (v == 100), 2);
    const std::vector<float> deep = values_of(png(256, 1, {16, 0}, words, extra));
    for (std::size_t v = 0; v < 256; ++v)
      CHECK(deep[v] == static_cast<float>(static_cast<double>(257 * v + (v == 100)) / 65535));
  }
}

TEST_CASE("a PNG of one, two or four bits, or with a palette, has the full range") {
  CHECK(values_of(png(4, 1, {1, 0}, "\x50")) == std::vector<float>{0, 1, 0, 1});
  CHECK(values_of(png(4, 1, {2, 0}, "\x1b")) == std::vector<float>{0, 1 / 3.0f, 2 / 3.0f, 1});
  CHECK(values_of(png(2, 1, {4, 0}, "\x3f")) == std::vector<float>{0.2f, 1});
  const std::string palette = png_chunk("PLTE", std::string("\xff\xff\xff\0\0\0", 6));
  CHECK(values_of(png(2, 1, {8, 3}, std::string("\1\0", 2), palette)) == std::vector<float>{0, 1});
}

TEST_CASE("a PNG's colours become luminance") {
  std::string grays;
  for (char c : all_bytes()) grays += std::string(3, c);
  const std::vector<float> same = values_of(png(256, 1, {8, 2}, grays));
  for (std::size_t v = 0; v < 256; ++v)
    CHECK(same[v] == Approx(static_cast<double>(v) / 255).margin(1.01 * kStep));
  const std::vector<float> colors = values_of(png(3, 1, {8, 2}, std::string("\0\0\xff\xff\0\0\0\xff\0", 9)));
  CHECK((0 < colors[0] && colors[0] < colors[1] && colors[1] < colors[2] && colors[2] < 1));
}

TEST_CASE("what is transparent in a PNG is black, and what is opaque is as it is") {
  CHECK(values_of(png(3, 1, {8, 4}, std::string("\xff\0\xff\xff\x40\xff", 6))) ==
        std::vector<float>{0, 1, static_cast<float>(64 / 255.0)});
  const std::string words = bytes_of(0xffff, 2) + bytes_of(0, 2) + bytes_of(0x1234, 2) + bytes_of(0xffff, 2);
  CHECK(values_of(png(2, 1, {16, 4}, words)) == std::vector<float>{0, static_cast<float>(0x1234 / 65535.0)});
  CHECK(values_of(png(2, 1, {8, 6}, std::string("\xff\xff\xff\0\xff\xff\xff\xff", 8))) ==
        std::vector<float>{0, 1});
}

TEST_CASE("what is not a picture, or a wrong one, is refused with the reason") {
  CHECK(why_not("garbage") == "is not a picture that can be read here; allowed: PNG, or PGM (P2 or P5)");
  CHECK_THAT(why_not("P6 1 1 255\nabc"), Contains("is not a picture"));
  CHECK(why_not("") == "the file is empty");
  CHECK(why_not("P2") == "ends before its width");
  CHECK(why_not("P2 3") == "ends before its height");
  CHECK(why_not("P2 3 1 ") == "ends before its largest value");
  CHECK(why_not("P2 0 1 9 1") == "has 0 x 1 pixels; allowed: at least one");
  CHECK(why_not("P2 -3 1 9 1") == "has no number at byte 3, where its width should stand");
  CHECK(why_not("P2 3x 1 9 1") == "has no number at byte 4, where its width should stand");
  CHECK(why_not("P2 99999999999999999999 1 9 1") == "its width has too many digits");
  CHECK(why_not("P2 1 1 0 0") == "has the largest value 0; allowed: 1 to 65535");
  CHECK(why_not("P2 1 1 65536 0") == "has the largest value 65536; allowed: 1 to 65535");
  CHECK(why_not("P2 2 1 9 1 10") == "has the value 10, more than its largest, 9");
  CHECK(why_not("P2 2 1 9 1") == "ends before its last pixel");
  CHECK(why_not("P2 1 1 9 1 2") == "goes on after its last pixel");
  CHECK(why_not("P5 2 1 9\n\1") == "ends before its last pixel");
  CHECK(why_not("P5 1 1 9\n\1\2") == "goes on after its last pixel");
  CHECK(why_not("P5 1 1 9#\n\1") == "has no blank between its header and its pixels");
  CHECK(why_not("P5 1 1 9\n\x0a") == "has the value 10, more than its largest, 9");
  CHECK(why_not("\x89PNG") == "ends before its last part (IEND); the file was cut off");
  CHECK_THAT(why_not(png(0, 1, {8, 0}, "")), Contains("is damaged: "));
  CHECK_THAT(why_not(png(2, 2, {8, 0}, "ab")), Contains("is damaged: "));  // two rows of one byte
}

TEST_CASE("a picture too large is refused before room is made for it") {
  CHECK(why_not("P5 20000 20000 255\n") ==
        "has 20000 x 20000 pixels; allowed: at most 134217728; scale it down");
  CHECK(why_not("P2 4000000000 4000000000 255\n") ==
        "has 4000000000 x 4000000000 pixels; allowed: at most 134217728; scale it down");
  CHECK(why_not("P2 10000 10000 255\n1 2 3") == "ends before its last pixel");
  CHECK(why_not(png(20000, 20000, {8, 0}, std::string(20000, 'a'))) ==
        "has 20000 x 20000 pixels; allowed: at most 134217728; scale it down");
}

TEST_CASE("a picture cut off anywhere is refused, and one changed anywhere never takes the program down") {
  const auto slope = [](int i, int j) { return static_cast<std::uint32_t>(40 * i + 7 * j + 1); };
  const std::vector<std::string> pictures = {pgm(5, 4, 255, slope), pgm(5, 4, 65535, slope),
                                             png(16, 16, {8, 0}, all_bytes()), png(8, 8, {8, 6}, all_bytes()),
                                             png(8, 8, {16, 4}, all_bytes())};
  for (const std::string& whole : pictures) {
    REQUIRE(why_not(whole) == "no error");
    for (std::size_t n = 0; n < whole.size(); ++n) {
      CAPTURE(n);
      REQUIRE(why_not(whole.substr(0, n)) != "no error");
      for (const int flip : {0x01, 0x41, 0xff}) {
        std::string changed = whole;
        changed[n] = static_cast<char>(changed[n] ^ flip);
        try {
          const std::vector<float> values = values_of(changed);
          for (float v : values) REQUIRE((v >= 0 && v <= 1));
        } catch (const Error& error) {
          REQUIRE(error.code() == ExitCode::input);
        }
      }
    }
  }
}
