#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/cli/study/errors.h"
#include "tools/cli/study/resample.h"
#include "tools/cli/study/truth.h"

namespace firn {
namespace {

// What a sequence's order must lie between to be believed, and what is then made of it.
constexpr double kLeastOrder = 0.5, kMostOrder = 4, kMostAssumed = 2;

class FinestTruth : public Truth {
 public:
  FinestTruth(const FinestRuns& form, std::vector<std::vector<BodyPoints>> levels, int dimension)
      : sizes_(form.cell_sizes), levels_(std::move(levels)) {
    for (const auto& level : levels_) {
      auto& fields = fields_.emplace_back();
      for (const BodyPoints& body : level) fields.emplace_back(body, dimension);
    }
    compare_levels();
  }

  std::vector<BodyPoints> at(const std::vector<BodyPoints>& run) const override {
    std::vector<BodyPoints> out = level_at(levels_.size() - 1, run);
    const std::vector<BodyPoints> coarser = level_at(levels_.size() - 2, run);
    for (std::size_t b = 0; b < run.size(); ++b) {
      extrapolate(kDisplacement, coarser[b].displacement, out[b].displacement);
      extrapolate(kVelocity, coarser[b].velocity, out[b].velocity);
      extrapolate(kStress, coarser[b].stress, out[b].stress);
    }
    return out;
  }

  bool knows(StudyQuantity) const override { return true; }
  double uncertainty(StudyQuantity q) const override { return facts_[q].uncertainty; }
  std::optional<double> order(StudyQuantity q) const override { return facts_[q].order; }
  std::string text() const override {
    return fmt::format("runs with cells of {} m{}", fmt::join(sizes_, ", "),
                       facts_[kDisplacement].correction > 0 ? ", extrapolated" : "");
  }

 private:
  struct Facts {
    std::optional<double> order;
    double correction = 0;  // parts of the last difference that are added to the finest level
    double uncertainty = 0;
  };

  template <class T>
  void extrapolate(StudyQuantity q, const std::vector<T>& coarse, std::vector<T>& fine) const {
    for (std::size_t p = 0; p < fine.size(); ++p) fine[p] += facts_[q].correction * (fine[p] - coarse[p]);
  }

  std::vector<BodyPoints> level_at(std::size_t level, const std::vector<BodyPoints>& run) const {
    std::vector<BodyPoints> out;
    for (std::size_t b = 0; b < run.size(); ++b) {
      BodyPoints& body = out.emplace_back(run[b].size());
      body.start = run[b].start;
      body.mass = run[b].mass;
      fields_[level][b].fill(body);
    }
    return out;
  }

  /// All at the places of the coarsest level's particles.
  void compare_levels() {
    const std::vector<BodyPoints>& coarse = levels_.front();
    const std::size_t last = levels_.size() - 1;
    const auto fine = level_at(last, coarse), before = level_at(last - 1, coarse);
    const auto difference = differences(before, fine, fine);
    const double ratio = sizes_[last - 1] / sizes_[last];
    std::array<ErrorNorms, kQuantities> first;
    if (levels_.size() == 3) first = differences(coarse, before, fine);
    for (std::size_t q = 0; q < kQuantities; ++q) {
      Facts& facts = facts_[q];
      const double last_difference = difference[q].l2.value_or(0);
      facts.uncertainty = 3 * last_difference;
      if (!first[q].l2 || last_difference == 0) continue;
      const double order = std::log(*first[q].l2 / last_difference) / std::log(ratio);
      facts.order = order;
      if (order < kLeastOrder || order > kMostOrder) continue;
      facts.correction = 1 / (std::pow(ratio, std::min(order, kMostAssumed)) - 1);
      facts.uncertainty = 1.25 * facts.correction * last_difference;
    }
  }

  std::vector<double> sizes_;
  std::vector<std::vector<BodyPoints>> levels_;
  std::vector<std::vector<Resampler>> fields_;  // by level and body; they look into levels_
  std::array<Facts, kQuantities> facts_;
};

}  // namespace

std::unique_ptr<Truth> finest_truth(const FinestRuns& form, std::vector<std::vector<BodyPoints>> levels,
                                    int dimension) {
  return std::make_unique<FinestTruth>(form, std::move(levels), dimension);
}

}  // namespace firn
