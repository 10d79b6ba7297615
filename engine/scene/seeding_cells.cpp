#include "engine/scene/seeding_cells.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "engine/base/error.h"

namespace firn {
namespace {

constexpr double kMostCells = 1e11;
constexpr double kFarthestCell = 1e15;

/// Farther than half a cell's diagonal from the surface; a quarter more for the interpolation error of level
/// sets.
double safe_depth(const CellBox& cells) {
  return 1.25 * 0.5 * cells.size * std::sqrt(cells.dimension);
}

CellIndex first_of_row(const CellBox& cells, std::size_t row) {
  const auto r = static_cast<std::int64_t>(row);
  return {cells.begin[0], cells.begin[1] + r % cells.count(1), cells.begin[2] + r / cells.count(1)};
}

Vec3 point_in(const CellBox& cells, const CellIndex& cell, const Vec3& fraction) {
  Vec3 x = Vec3::Zero();
  for (int axis = 0; axis < cells.dimension; ++axis) {
    x[axis] = (static_cast<double>(cell[static_cast<std::size_t>(axis)]) + fraction[axis]) * cells.size;
  }
  return x;
}

/// Sub-cells per axis for measure(): the error falls with their square, the work grows with their cube.
int subdivision(int dimension) {
  return dimension == 3 ? 4 : dimension == 2 ? 16 : 64;
}

std::vector<Vec3> sub_cell_middles(int dimension) {
  const int n = subdivision(dimension);
  std::vector<Vec3> middles;
  for (int k = 0; k < (dimension > 2 ? n : 1); ++k) {
    for (int j = 0; j < (dimension > 1 ? n : 1); ++j) {
      for (int i = 0; i < n; ++i) middles.push_back((Vec3(i, j, k).array() + 0.5) / n);
    }
  }
  return middles;
}

}  // namespace

CellBox covering_cells(const Bounds& bounds, int dimension, double size) {
  CellBox cells{dimension, size};
  if (bounds.empty()) {
    cells.end = cells.begin;
    return cells;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (axis >= dimension) {
      if (bounds.min[axis] > 0 || bounds.max[axis] < 0) cells.end[a] = 0;
      continue;
    }
    if (!std::isfinite(bounds.min[axis]) || !std::isfinite(bounds.max[axis])) {
      throw Error(ExitCode::input, "the shape has no end; intersect a plane with a box to make a body of it");
    }
    const double low = std::floor(bounds.min[axis] / size), high = std::floor(bounds.max[axis] / size) + 1;
    if (!(std::abs(low) < kFarthestCell && std::abs(high) < kFarthestCell)) {
      throw Error(ExitCode::resources,
                  fmt::format("the shape reaches from {:.4g} to {:.4g} m, too far for cells of {:.3g} m",
                              bounds.min[axis], bounds.max[axis], size));
    }
    cells.begin[a] = static_cast<std::int64_t>(low);
    cells.end[a] = static_cast<std::int64_t>(high);
  }
  if (cells.cells() > kMostCells) {
    throw Error(ExitCode::resources,
                fmt::format("the shape's bounding box has {:.3g} cells of {:.3g} m, more than {:.0g}; "
                            "choose a larger cell_size",
                            cells.cells(), size, kMostCells));
  }
  return cells;
}

void visit_row(const Shape& shape, const CellBox& cells, std::size_t row,
               const std::function<void(const CellIndex&, Cover)>& visit) {
  constexpr std::int64_t piece = 256;
  std::array<Vec3, piece> middles;
  std::array<double, piece> phi;
  const double depth = safe_depth(cells);
  CellIndex cell = first_of_row(cells, row);
  while (cell[0] < cells.end[0]) {
    const auto n = static_cast<std::size_t>(std::min(piece, cells.end[0] - cell[0]));
    for (std::size_t i = 0; i < n; ++i) {
      middles[i] =
          point_in(cells, {cell[0] + static_cast<std::int64_t>(i), cell[1], cell[2]}, Vec3::Constant(0.5));
    }
    shape.distance(std::span(middles).first(n), std::span(phi).first(n));
    for (std::size_t i = 0; i < n; ++i, ++cell[0]) {
      if (phi[i] < depth) visit(cell, phi[i] < -depth ? Cover::inside : Cover::surface);
    }
  }
}

std::vector<Vec3> points_inside(const Shape& shape, const CellBox& cells, const CellPoints& points_of) {
  std::vector<std::vector<Vec3>> rows(cells.rows());
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
    std::vector<Vec3>& points = rows[row];
    std::vector<Vec3> doubtful;
    std::vector<std::size_t> doubtful_at;
    visit_row(shape, cells, row, [&](const CellIndex& cell, Cover cover) {
      const std::size_t first = points.size();
      points_of(cell, points);
      if (cover == Cover::inside) return;
      for (std::size_t i = first; i < points.size(); ++i) {
        doubtful.push_back(points[i]);
        doubtful_at.push_back(i);
      }
    });
    if (doubtful.empty()) return;
    std::vector<double> phi(doubtful.size());
    shape.distance(doubtful, phi);
    std::size_t kept = doubtful_at.front(), next = 0;
    for (std::size_t i = kept; i < points.size(); ++i) {
      const bool is_doubtful = next < doubtful_at.size() && doubtful_at[next] == i;
      if (is_doubtful && phi[next++] > 0) continue;
      points[kept++] = points[i];
    }
    points.resize(kept);
  });

  std::vector<std::size_t> offset(rows.size() + 1, 0);
  for (std::size_t row = 0; row < rows.size(); ++row) offset[row + 1] = offset[row] + rows[row].size();
  std::vector<Vec3> all(offset.back());
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
    std::copy(rows[row].begin(), rows[row].end(), all.begin() + static_cast<std::ptrdiff_t>(offset[row]));
    rows[row] = {};
  });
  return all;
}

double measure(const Shape& shape, const CellBox& cells) {
  const std::vector<Vec3> middles = sub_cell_middles(cells.dimension);
  const double sub_size = cells.size / subdivision(cells.dimension);
  std::vector<double> rows(cells.rows(), 0.0);  // summed in order afterwards, so the result has one value
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
    std::vector<Vec3> points(middles.size());
    std::vector<double> phi(middles.size());
    visit_row(shape, cells, row, [&](const CellIndex& cell, Cover cover) {
      if (cover == Cover::inside) {
        rows[row] += 1;
        return;
      }
      for (std::size_t i = 0; i < middles.size(); ++i) points[i] = point_in(cells, cell, middles[i]);
      shape.distance(points, phi);
      double solid = 0;
      // A sub-cell cut by the surface counts by how far the surface is from its middle.
      for (double d : phi) solid += std::clamp(0.5 - d / sub_size, 0.0, 1.0);
      rows[row] += solid / static_cast<double>(middles.size());
    });
  });
  double sum = 0;
  for (double row : rows) sum += row;
  return sum * std::pow(cells.size, cells.dimension);
}

}  // namespace firn
