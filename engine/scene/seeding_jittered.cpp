#include <cmath>

#include "engine/scene/seeding_hash.h"
#include "engine/scene/seeding_patterns.h"

namespace firn {
namespace {

struct Strata {
  std::int64_t per_axis;
  double cell_size;  // m: of what is cut into per_axis strata along each axis
};

Strata strata_for(int dimension, double cell_size, double per_cell) {
  const double per_axis = std::round(std::pow(per_cell, 1.0 / dimension));
  if (per_axis >= 1 && std::pow(per_axis, dimension) == per_cell) {
    return {static_cast<std::int64_t>(per_axis), cell_size};
  }
  // Any number a cell: strata of the right volume, visited two by two.
  return {2, 2 * cell_size * std::pow(per_cell, -1.0 / dimension)};
}

}  // namespace

PointPattern jittered_pattern(int dimension, double cell_size, double per_cell, std::uint64_t key,
                              double amount) {
  const Strata strata = strata_for(dimension, cell_size, per_cell);
  const std::int64_t n = strata.per_axis;
  const double size = strata.cell_size / static_cast<double>(n);
  const std::int64_t ny = dimension > 1 ? n : 1, nz = dimension > 2 ? n : 1;
  const auto points_of = [=](const CellIndex& cell, std::vector<Vec3>& out) {
    for (std::int64_t k = 0; k < nz; ++k) {
      for (std::int64_t j = 0; j < ny; ++j) {
        for (std::int64_t i = 0; i < n; ++i) {
          const CellIndex stratum{cell[0] * n + i, cell[1] * n + j, cell[2] * n + k};
          const Vec3 u = (amount * (jitter(key, stratum).array() - 0.5) + 0.5).matrix();
          Vec3 x = Vec3::Zero();
          for (int axis = 0; axis < dimension; ++axis) {
            x[axis] = (static_cast<double>(stratum[static_cast<std::size_t>(axis)]) + u[axis]) * size;
          }
          out.push_back(x);
        }
      }
    }
  };
  return {strata.cell_size, points_of};
}

}  // namespace firn
