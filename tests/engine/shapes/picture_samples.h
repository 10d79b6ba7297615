// Pictures for tests, written without libpng so that it is not its own judge.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace firn::test {

/// Big-endian, as PNG and PGM have numbers.
inline std::string bytes_of(std::uint32_t value, int count) {
  std::string out;
  for (int i = count; i-- > 0;) out += static_cast<char>((value >> (8 * i)) & 0xff);
  return out;
}

/// A raw PGM whose pixel in column i and row j from the top is `value(i, j)`.
inline std::string pgm(int width, int height, std::uint32_t most,
                       const std::function<std::uint32_t(int, int)>& value) {
  std::string out =
      "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + std::to_string(most) + "\n";
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) out += bytes_of(value(i, j), most > 255 ? 2 : 1);
  return out;
}

/// The same with 16 bits of values from 0 to 1.
inline std::string gray(int width, int height, const std::function<double(int, int)>& value) {
  return pgm(width, height, 65535,
             [&](int i, int j) { return static_cast<std::uint32_t>(value(i, j) * 65535 + 0.5); });
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xffffffff;
  for (char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return bytes_of(static_cast<std::uint32_t>(data.size()), 4) + type + data + bytes_of(~crc, 4);
}

/// zlib's format without compression; less than 64 KiB.
inline std::string stored(const std::string& data) {
  std::uint32_t a = 1, b = 0;
  for (char c : data) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint32_t>(data.size());
  const auto little = [](std::uint32_t v) { return bytes_of(v & 0xff, 1) + bytes_of(v >> 8, 1); };
  return "\x78\x01\x01" + little(size) + little(size ^ 0xffff) + data + bytes_of((b << 16) | a, 4);
}

struct PngKind {
  int depth = 8;
  int color = 0;  // 0 gray, 2 RGB, 3 palette, 4 gray and alpha, 6 RGBA
};

/// `rows`: the bytes of all rows, each of the same length. `extra`: chunks before the pixels.
inline std::string png(int width, int height, PngKind kind, const std::string& rows,
                       const std::string& extra = {}) {
  const std::string head = bytes_of(static_cast<std::uint32_t>(width), 4) +
                           bytes_of(static_cast<std::uint32_t>(height), 4) +
                           std::string{static_cast<char>(kind.depth), static_cast<char>(kind.color), 0, 0, 0};
  const std::size_t length = rows.size() / static_cast<std::size_t>(height);
  std::string filtered;
  for (std::size_t at = 0; at < rows.size(); at += length)
    filtered += std::string(1, '\0') + rows.substr(at, length);
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", head) + extra + png_chunk("IDAT", stored(filtered)) +
         png_chunk("IEND", "");
}

}  // namespace firn::test
