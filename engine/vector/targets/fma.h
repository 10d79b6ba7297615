// The multiply-adds of each instruction set, in its own namespace.
#pragma once

#include "engine/vector/fma.h"

#define FIRN_DECLARE_FMA(isa)   \
  namespace firn::isa {         \
  template <class Real>         \
  FmaBurst fma_burst();         \
  template <>                   \
  FmaBurst fma_burst<float>();  \
  template <>                   \
  FmaBurst fma_burst<double>(); \
  }

FIRN_DECLARE_FMA(sse4)
FIRN_DECLARE_FMA(avx2)
FIRN_DECLARE_FMA(avx512)
