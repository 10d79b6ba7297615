#include "engine/vector/targets/sorts.h"

#include "engine/vector/cell_keys.h"
#include "engine/vector/tile_moves.h"

namespace firn::FIRN_ISA {

template <>
SortKernels<float> sort_kernels<float, 2>() {
  return {cell_keys<float, 2>, move_tiles<float, 2>};
}
template <>
SortKernels<float> sort_kernels<float, 3>() {
  return {cell_keys<float, 3>, move_tiles<float, 3>};
}
template <>
SortKernels<double> sort_kernels<double, 2>() {
  return {cell_keys<double, 2>, move_tiles<double, 2>};
}
template <>
SortKernels<double> sort_kernels<double, 3>() {
  return {cell_keys<double, 3>, move_tiles<double, 3>};
}

}  // namespace firn::FIRN_ISA
