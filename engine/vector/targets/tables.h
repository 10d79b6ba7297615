// What each instruction set's build defines, in its own namespace.
#pragma once

#include "engine/vector/kernel_tables.h"

#define FIRN_DECLARE_TABLES(isa)                    \
  namespace firn::isa {                             \
  template <class Real, int D>                      \
  KernelTable<Real, D> kernel_table();              \
  template <class Real, int D>                      \
  const MaterialKernel<Real>* material_kernels();   \
  template <>                                       \
  KernelTable<float, 2> kernel_table<float, 2>();   \
  template <>                                       \
  KernelTable<float, 3> kernel_table<float, 3>();   \
  template <>                                       \
  KernelTable<double, 2> kernel_table<double, 2>(); \
  template <>                                       \
  KernelTable<double, 3> kernel_table<double, 3>(); \
  }

FIRN_DECLARE_TABLES(sse4)
FIRN_DECLARE_TABLES(avx2)
FIRN_DECLARE_TABLES(avx512)
