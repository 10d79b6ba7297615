// The cells of a lattice aligned with the grid's origin that a shape touches, visited row by row in parallel.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "engine/shapes/shape.h"

namespace firn {

using CellIndex = std::array<std::int64_t, 3>;

/// Cell (i, j, k) covers [i, i + 1) x [j, j + 1) x [k, k + 1) times `size`. In one or two dimensions the
/// others stay at index 0, and coordinate 0.
struct CellBox {
  int dimension = 3;
  double size = 0;
  CellIndex begin{0, 0, 0}, end{1, 1, 1};

  std::int64_t count(int axis) const {
    return end[static_cast<std::size_t>(axis)] - begin[static_cast<std::size_t>(axis)];
  }
  std::size_t rows() const { return static_cast<std::size_t>(count(1) * count(2)); }
  double cells() const {
    return static_cast<double>(count(0)) * static_cast<double>(count(1)) * static_cast<double>(count(2));
  }
};

/// Cells of `size` that cover `bounds`; no cells when the bounds are empty or miss the plane or line the
/// scene lies in. Throws Error{input} for infinite bounds and Error{resources} for more cells than can be
/// visited.
CellBox covering_cells(const Bounds& bounds, int dimension, double size);

enum class Cover { inside, surface };

/// Calls `visit` for each cell of row `row` (x fastest) that is not wholly outside, in order. `inside` cells
/// need no further look: distances never exceed the true ones, so a cell whose middle is deep enough is
/// solid.
void visit_row(const Shape& shape, const CellBox& cells, std::size_t row,
               const std::function<void(const CellIndex&, Cover)>& visit);

/// Adds the points of one cell, in a fixed order.
using CellPoints = std::function<void(const CellIndex&, std::vector<Vec3>&)>;

/// The points of all cells that lie in the shape, ordered by cell. The same for any number of threads.
std::vector<Vec3> points_inside(const Shape& shape, const CellBox& cells, const CellPoints& points_of);

/// Length, area or volume of the part of the shape in the scene's line, plane or space, by sampling the
/// surface cells.
double measure(const Shape& shape, const CellBox& cells);

}  // namespace firn
