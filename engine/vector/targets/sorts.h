// The kernels of the sort of each instruction set, in its own namespace.
#pragma once

#include "engine/passes/sort_kernels.h"

#define FIRN_DECLARE_SORTS(isa)                  \
  namespace firn::isa {                          \
  template <class Real, int D>                   \
  SortKernels<Real> sort_kernels();              \
  template <>                                    \
  SortKernels<float> sort_kernels<float, 2>();   \
  template <>                                    \
  SortKernels<float> sort_kernels<float, 3>();   \
  template <>                                    \
  SortKernels<double> sort_kernels<double, 2>(); \
  template <>                                    \
  SortKernels<double> sort_kernels<double, 3>(); \
  }

FIRN_DECLARE_SORTS(sse4)
FIRN_DECLARE_SORTS(avx2)
FIRN_DECLARE_SORTS(avx512)
