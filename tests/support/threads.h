// Work done with a number of threads, whatever the machine has.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace firn::test {

/// Runs `f` in an arena of `threads`. A limit alone never gives more threads than there are cores.
template <class F>
auto with_threads(int threads, F&& f) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  return tbb::task_arena(threads).execute(f);
}

}  // namespace firn::test
