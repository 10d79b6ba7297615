// The particles of a run as a field over the undeformed body, to be looked at in any place.
#pragma once

#include <memory>
#include <span>

#include "tools/cli/study/points.h"

namespace firn {

/// Displacement, velocity and stress fitted about a place by a quadratic in the coordinates at the start,
/// over the nearest particles, the nearer the heavier (moving least squares, Lancaster & Salkauskas 1981):
/// what varies quadratically comes out exactly. Where there are too few particles for that the fit is linear,
/// or a mean.
class Resampler {
 public:
  /// `points` must stay where they are.
  Resampler(const BodyPoints& points, int dimension);
  ~Resampler();
  Resampler(Resampler&&) noexcept;

  /// `out.start` says where; the other columns are filled, but for the mass.
  void fill(BodyPoints& out) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace firn
