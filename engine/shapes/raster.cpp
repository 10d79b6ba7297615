#include "engine/shapes/raster.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/picture.h"

namespace firn {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& why) {
  throw Error(ExitCode::input, quoted(file) + ": " + why);
}

/// A file name of a stack: what stands before and after the number, and its least number of digits.
struct Pattern {
  std::string before, after;
  std::size_t digits;

  std::string name(std::uint64_t number) const {
    return fmt::format("{}{:0{}}{}", before, number, digits, after);
  }

  std::optional<std::uint64_t> number_of(const std::string& name) const {
    if (name.size() < before.size() + digits + after.size() || !name.starts_with(before) ||
        !name.ends_with(after))
      return std::nullopt;
    const std::string_view text =
        std::string_view(name).substr(before.size(), name.size() - before.size() - after.size());
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && this->name(number) == name ? std::optional(number) : std::nullopt;
  }
};

Pattern pattern_of(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::size_t begin = name.find('#'), end = std::min(name.find_first_not_of('#', begin), name.size());
  if (name.find('#', end) != std::string::npos)
    fail(file, "has several runs of '#'; allowed: one, for the numbers of the slices");
  return {name.substr(0, begin), name.substr(end), end - begin};
}

/// The numbers in order, without a gap.
std::vector<std::uint64_t> numbers_in_folder(const fs::path& file, const Pattern& pattern) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::vector<std::uint64_t> numbers;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (const auto number = pattern.number_of(entry->path().filename().string())) numbers.push_back(*number);
  }
  if (error) fail(folder, error.message());
  if (numbers.empty()) {
    fail(file, fmt::format("no file of that name with a number for its '#', such as '{}'",
                           printable(pattern.name(1))));
  }
  std::sort(numbers.begin(), numbers.end());
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] == numbers[i - 1] + 1) continue;
    fail(file, fmt::format("'{}' is missing, between {} and {}; allowed: slices without a gap",
                           printable(pattern.name(numbers[i - 1] + 1)), numbers[i - 1], numbers[i]));
  }
  return numbers;
}

/// Above what is there already; pictures have their first row at the top.
void append(Raster& raster, const Picture& picture) {
  for (std::size_t row = picture.height; row-- > 0;) {
    const auto begin = picture.value.begin() + static_cast<std::ptrdiff_t>(row * picture.width);
    raster.value.insert(raster.value.end(), begin, begin + static_cast<std::ptrdiff_t>(picture.width));
  }
}

Raster read_stack(const fs::path& file) {
  const Pattern pattern = pattern_of(file);
  const std::vector<std::uint64_t> numbers = numbers_in_folder(file, pattern);
  Raster raster;
  for (const std::uint64_t number : numbers) {
    const fs::path slice = file.parent_path() / pattern.name(number);
    const Picture picture = read_picture(slice, kMostPixels / numbers.size());
    if (raster.value.empty()) {
      raster.count = {picture.width, picture.height, numbers.size()};
      raster.value.reserve(picture.width * picture.height * numbers.size());
    } else if (picture.width != raster.count[0] || picture.height != raster.count[1]) {
      fail(slice, fmt::format("has {} x {} pixels; allowed: {} x {}, which the first slice, '{}', has",
                              picture.width, picture.height, raster.count[0], raster.count[1],
                              printable(pattern.name(numbers.front()))));
    }
    append(raster, picture);
  }
  return raster;
}

}  // namespace

bool names_a_stack(const fs::path& file) {
  return file.filename().string().find('#') != std::string::npos;
}

Raster read_raster(const fs::path& file) {
  if (names_a_stack(file)) return read_stack(file);
  const Picture picture = read_picture(file);
  Raster raster{{picture.width, picture.height, 1}, {}};
  raster.value.reserve(picture.value.size());
  append(raster, picture);
  return raster;
}

}  // namespace firn
