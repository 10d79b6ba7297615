// A user's file as bytes, read with care: a device, a pipe or a file too large never gets as far as a parser.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace firn {

inline constexpr std::uint64_t kLargestTextFile = std::uint64_t{1} << 30;

/// `path` in quotes, safe for a terminal: how messages name a file.
std::string quoted(const std::filesystem::path& path);

/// The whole of a regular file of 1 to `limit` bytes; anything else throws Error{input} saying why.
std::vector<std::uint8_t> read_regular_file(const std::filesystem::path& path,
                                            std::uint64_t limit = kLargestTextFile);

/// The checks of read_regular_file without reading; returns the size.
std::uint64_t check_regular_file(const std::filesystem::path& path, std::uint64_t limit);

}  // namespace firn
