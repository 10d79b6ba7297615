// Where particles lie within cells: the two samplings a scene can choose between.
//
// Jittered: the cell is cut into strata of equal size, one point at random in each. Interior cells hold
// exactly the wanted number when it is a square (2D) or cube (3D); otherwise the strata do not follow the
// cells and the number holds on average.
//
// Poisson: points at least `poisson_distance` apart. A periodic block of cells is filled once by random
// sequential addition up to exactly the wanted number, and then repeated through space. The distance is 0.415
// cells for 8 a cell in 3D and scales with the number wanted; it is 78 % of the density at which random
// addition jams, which keeps the search short. The number in a body differs from volume times density only at
// its surface.
#pragma once

#include <cstdint>

#include "engine/scene/seeding_cells.h"

namespace firn {

struct PointPattern {
  double cell_size;  // m: of the cells that `points_of` is called with
  CellPoints points_of;
};

/// `amount` is the jitter as part of a stratum: 1 fills it, 0 puts each point in the middle.
PointPattern jittered_pattern(int dimension, double cell_size, double per_cell, std::uint64_t key,
                              double amount);

PointPattern poisson_pattern(int dimension, double cell_size, double per_cell, std::uint64_t key);

/// In metres.
double poisson_distance(int dimension, double cell_size, double per_cell);

}  // namespace firn
