// What many measurements of the same say: noise only ever adds time, so the best is what the machine can do;
// the median shows how far away it usually is.
#pragma once

#include <algorithm>
#include <vector>

namespace firn {

inline double best(const std::vector<double>& samples) {
  return *std::min_element(samples.begin(), samples.end());
}

/// The middle one; of two in the middle, the larger.
inline double median(std::vector<double> samples) {
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

}  // namespace firn
