// From a kernel's name in a scene to its type: what a kernel is like is said there and nowhere else.
#pragma once

#include <utility>

#include "engine/grid/kernel.h"
#include "engine/scene/description.h"

namespace firn {

/// f of a value of the kernel's type.
template <class F>
decltype(auto) with_kernel(KernelName name, F&& f) {
  switch (name) {
    case KernelName::linear:
      return std::forward<F>(f)(LinearKernel{});
    case KernelName::gimp:
      return std::forward<F>(f)(GimpKernel{});
    case KernelName::cubic:
      return std::forward<F>(f)(CubicKernel{});
    case KernelName::quadratic:
      break;
  }
  return std::forward<F>(f)(QuadraticKernel{});
}

}  // namespace firn
