// Copies a frame's columns into arrays, in parallel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "engine/particles/frame_view.h"

namespace firn {

/// All values of one column, `components` a particle, filled by copy(first particle, span to fill).
template <class T, class Copy>
std::vector<T> gather(std::size_t particles, std::size_t components, const Copy& copy) {
  constexpr std::size_t kGrain = 16384;  // enough to pay for a task
  std::vector<T> out(particles * components);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles, kGrain), [&](const auto& range) {
    copy(range.begin(), std::span<T>(out).subspan(range.begin() * components, range.size() * components));
  });
  return out;
}

}  // namespace firn
