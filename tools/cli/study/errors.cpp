#include "tools/cli/study/errors.h"

#include <algorithm>
#include <cmath>

namespace firn {
namespace {

struct Sums {
  double error2 = 0, truth2 = 0, max_error = 0, max_truth = 0;

  void add(double mass, double error, double truth) {
    error2 += mass * error * error;
    truth2 += mass * truth * truth;
    max_error = std::max(max_error, error);
    max_truth = std::max(max_truth, truth);
  }
  ErrorNorms norms() const {
    // Not finite is no error of any size.
    if (!(truth2 > 0) || !std::isfinite(error2 + truth2)) return {};
    return {std::sqrt(error2 / truth2), max_error / max_truth};
  }
};

}  // namespace

std::array<ErrorNorms, kQuantities> errors(const std::vector<BodyPoints>& run,
                                           const std::vector<BodyPoints>& truth) {
  return differences(run, truth, truth);
}

std::array<ErrorNorms, kQuantities> differences(const std::vector<BodyPoints>& a,
                                                const std::vector<BodyPoints>& b,
                                                const std::vector<BodyPoints>& scale) {
  std::array<Sums, kQuantities> sums;
  for (std::size_t body = 0; body < a.size(); ++body)
    for (std::size_t p = 0; p < a[body].size(); ++p) {
      const auto add = [&](StudyQuantity q, auto column) {
        const auto& of_b = (b[body].*column)[p];
        sums[q].add(a[body].mass[p], ((a[body].*column)[p] - of_b).norm(), (scale[body].*column)[p].norm());
      };
      add(kDisplacement, &BodyPoints::displacement);
      add(kVelocity, &BodyPoints::velocity);
      add(kStress, &BodyPoints::stress);
    }
  return {sums[kDisplacement].norms(), sums[kVelocity].norms(), sums[kStress].norms()};
}

}  // namespace firn
