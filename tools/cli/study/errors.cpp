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
  std::array<Sums, kQuantities> sums;
  for (std::size_t b = 0; b < run.size(); ++b)
    for (std::size_t p = 0; p < run[b].size(); ++p) {
      const double m = run[b].mass[p];
      const auto add = [&](StudyQuantity q, const auto& is, const auto& should) {
        sums[q].add(m, (is - should).norm(), should.norm());
      };
      add(kDisplacement, run[b].displacement[p], truth[b].displacement[p]);
      add(kVelocity, run[b].velocity[p], truth[b].velocity[p]);
      add(kStress, run[b].stress[p], truth[b].stress[p]);
    }
  return {sums[kDisplacement].norms(), sums[kVelocity].norms(), sums[kStress].norms()};
}

}  // namespace firn
