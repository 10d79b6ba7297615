// The kernels of one instruction set, as a table: what a build for it exports.
#pragma once

#include "engine/vector/kernels.h"

namespace firn {

template <class Real, int D>
struct KernelTable {
  TransferKernels<Real, D> pic, apic, mls;
  GridKernels<Real, D> grid;
  const MaterialKernel<Real>* materials;  // by the index of the model in Material
};

}  // namespace firn
