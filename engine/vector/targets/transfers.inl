#include "engine/vector/grid_kernels.h"
#include "engine/vector/targets/tables.h"
#include "engine/vector/transfer_kernels.h"

namespace firn::FIRN_ISA {

template <>
KernelTable<FIRN_REAL, FIRN_DIMENSION> kernel_table<FIRN_REAL, FIRN_DIMENSION>() {
  constexpr int D = FIRN_DIMENSION;
  return {transfer_kernels<FIRN_REAL, D, PicTransfer>(), transfer_kernels<FIRN_REAL, D, ApicTransfer>(),
          transfer_kernels<FIRN_REAL, D, MlsTransfer>(), grid_kernels<FIRN_REAL, D>(),
          material_kernels<FIRN_REAL, D>()};
}

}  // namespace firn::FIRN_ISA
