// How many threads there are to work with.
#pragma once

#include <tbb/info.h>

namespace firn {

/// What the scheduler would use by itself: the cores this process may run on.
inline int default_threads() {
  return tbb::info::default_concurrency();
}

}  // namespace firn
