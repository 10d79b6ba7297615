// Sets of up to 64 numbers, a bit each.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace firn {

/// Calls f with each number in the set, in ascending order.
template <class F>
[[gnu::always_inline]] inline void for_each_bit(std::uint64_t set, F&& f) {
  for (; set != 0; set &= set - 1) f(static_cast<std::size_t>(std::countr_zero(set)));
}

}  // namespace firn
