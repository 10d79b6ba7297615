// How far a run is from the truth.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tools/cli/study/points.h"
#include "tools/cli/study/truth.h"

namespace firn {

/// Relative to the truth: of the mass-weighted L2 norm, and of the largest value. Empty where the truth is
/// zero.
struct ErrorNorms {
  std::optional<double> l2, max;
};

/// Particle by particle; stress by its Frobenius norm.
std::array<ErrorNorms, kQuantities> errors(const std::vector<BodyPoints>& run,
                                           const std::vector<BodyPoints>& truth);

/// How far `a` is from `b`, relative to the norms of `scale`.
std::array<ErrorNorms, kQuantities> differences(const std::vector<BodyPoints>& a,
                                                const std::vector<BodyPoints>& b,
                                                const std::vector<BodyPoints>& scale);

}  // namespace firn
