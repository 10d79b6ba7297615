#include "engine/scene/seeding_points.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/ply.h"

namespace firn {
namespace {

constexpr std::array<const char*, 6> kColumns{"x", "y", "z", "vx", "vy", "vz"};

[[noreturn]] void fail(const std::string& place, const std::string& why) {
  throw Error(ExitCode::input, place + ": " + why);
}

/// `place` is only called for the message: formatting it for every point would cost more than reading the
/// point.
template <class Place>
void check_point(const Vec3& x, const char* what, int dimension, Place place) {
  if (!x.allFinite())
    fail(place(), fmt::format("the {} ({}, {}, {}) is not finite", what, x.x(), x.y(), x.z()));
  for (int axis = dimension; axis < 3; ++axis) {
    if (x[axis] == 0) continue;
    fail(place(), fmt::format("the {} along {} is {}, but must be 0 in {} dimension{}", what, "xyz"[axis],
                              x[axis], dimension, dimension == 1 ? "" : "s"));
  }
}

/// Cells are separated by a comma or semicolon with blanks around it, or by blanks alone.
void split(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
  skip_blanks();
  for (bool more = true; more;) {
    const std::size_t length = std::min(line.find_first_of(",; \t"), line.size());
    cells.push_back(line.substr(0, length));
    line.remove_prefix(length);
    skip_blanks();
    more = !line.empty();
    if (more && (line.front() == ',' || line.front() == ';')) {
      line.remove_prefix(1);
      skip_blanks();
    }
  }
}

std::optional<double> number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

class CsvReader {
 public:
  CsvReader(std::string_view text, const std::string& file, int dimension)
      : text_(text), file_(file), dimension_(dimension) {}

  PointFile read() {
    std::vector<std::string_view> cells;
    while (!text_.empty()) {
      const std::string_view line = next_line();
      if (line.find_first_not_of(" \t") == std::string_view::npos || line.front() == '#') continue;
      split(line, cells);
      if (width_ == 0 && is_header(cells))
        read_header(cells);
      else
        read_point(cells);
    }
    return std::move(points_);
  }

 private:
  std::string place() const { return fmt::format("{}:{}", file_, line_); }

  std::string_view next_line() {
    const std::size_t newline = text_.find('\n');
    std::string_view line = text_.substr(0, newline);
    text_.remove_prefix(newline == std::string_view::npos ? text_.size() : newline + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++line_;
    return line;
  }

  static bool is_header(const std::vector<std::string_view>& cells) {
    return std::none_of(cells.begin(), cells.end(),
                        [](std::string_view cell) { return number(cell).has_value(); });
  }

  void read_header(const std::vector<std::string_view>& cells) {
    width_ = cells.size();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t k = 0; k < kColumns.size(); ++k) {
        if (cells[i] != kColumns[k]) continue;
        if (column_[k]) fail(place(), fmt::format("column '{}' twice", kColumns[k]));
        column_[k] = i;
      }
    }
    const bool velocity = column_[3] || column_[4] || column_[5];
    for (std::size_t k = 0; k < 6; ++k) {
      const bool needed = k % 3 < static_cast<std::size_t>(dimension_) && (k < 3 || velocity);
      if (needed && !column_[k]) {
        fail(place(),
             fmt::format("the header has no column '{}'; expected x,y,z or x,y,z,vx,vy,vz", kColumns[k]));
      }
    }
  }

  void take_columns_by_place(std::size_t width) {
    const auto d = static_cast<std::size_t>(dimension_);
    const std::size_t axes = (width == d || width == 2 * d) ? d : 3;
    if (width != axes && width != 2 * axes) {
      fail(place(), fmt::format("{} column{}; expected {}, or {} with velocities, or a header line x,y,z",
                                width, width == 1 ? "" : "s", axes, 2 * axes));
    }
    width_ = width;
    for (std::size_t i = 0; i < width; ++i) column_[3 * (i / axes) + i % axes] = i;
  }

  double value(const std::vector<std::string_view>& cells, std::size_t k) const {
    if (!column_[k]) return 0;
    const std::optional<double> parsed = number(cells[*column_[k]]);
    if (!parsed)
      fail(place(),
           fmt::format("'{}' is not a number (column {})", printable(cells[*column_[k]], 30), kColumns[k]));
    return *parsed;
  }

  void read_point(const std::vector<std::string_view>& cells) {
    if (width_ == 0) take_columns_by_place(cells.size());
    if (cells.size() != width_)
      fail(place(), fmt::format("{} values where {} are expected", cells.size(), width_));
    const Vec3 x(value(cells, 0), value(cells, 1), value(cells, 2));
    check_point(x, "position", dimension_, [&] { return place(); });
    points_.position.push_back(x);
    if (!column_[3]) return;
    const Vec3 v(value(cells, 3), value(cells, 4), value(cells, 5));
    check_point(v, "velocity", dimension_, [&] { return place(); });
    points_.velocity.push_back(v);
  }

  std::string_view text_;
  const std::string& file_;
  int dimension_;
  int line_ = 0;
  std::size_t width_ = 0;
  std::array<std::optional<std::size_t>, 6> column_;
  PointFile points_;
};

PointFile from_ply(std::span<const std::uint8_t> bytes, const std::string& file, int dimension) {
  const PlyFile ply = read_ply(bytes, file);
  const bool velocity = ply.vertex.contains("vx");
  PointFile points;
  points.position.resize(ply.vertex_count);
  points.velocity.resize(velocity ? ply.vertex_count : 0);
  for (std::size_t k = 0; k < (velocity ? 6 : 3); ++k) {
    const std::vector<double>& column = ply.column(kColumns[k], file);
    std::vector<Vec3>& out = k < 3 ? points.position : points.velocity;
    for (std::size_t i = 0; i < column.size(); ++i) out[i][static_cast<Eigen::Index>(k % 3)] = column[i];
  }
  for (std::size_t i = 0; i < ply.vertex_count; ++i) {
    const auto place = [&] { return fmt::format("{}: vertex {} of {}", file, i + 1, ply.vertex_count); };
    check_point(points.position[i], "position", dimension, place);
    if (velocity) check_point(points.velocity[i], "velocity", dimension, place);
  }
  return points;
}

}  // namespace

PointFile read_point_file(const std::filesystem::path& file, int dimension) {
  const std::string subject = quoted(file);
  const std::vector<std::uint8_t> bytes = read_regular_file(file);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  PointFile points = text.starts_with("ply") ? from_ply(bytes, subject, dimension)
                                             : CsvReader(text, subject, dimension).read();
  if (points.position.empty()) fail(subject, "holds no points");
  return points;
}

}  // namespace firn
