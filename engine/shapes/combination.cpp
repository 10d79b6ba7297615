#include "engine/shapes/combination.h"

#include <algorithm>
#include <array>

namespace firn {
namespace {

enum class Operation { unite, intersect, subtract };

class Combination final : public Shape {
 public:
  Combination(Operation operation, std::vector<ShapePtr> operands)
      : operation_(operation), operands_(std::move(operands)) {}

  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    // In pieces, so that the operands' distances need no heap.
    constexpr std::size_t piece = 64;
    std::array<double, piece> other;
    for (std::size_t begin = 0; begin < points.size(); begin += piece) {
      const std::size_t n = std::min(piece, points.size() - begin);
      const auto some = points.subspan(begin, n);
      const auto out = phi.subspan(begin, n);
      operands_.front()->distance(some, out);
      for (std::size_t k = 1; k < operands_.size(); ++k) {
        operands_[k]->distance(some, std::span(other).first(n));
        for (std::size_t i = 0; i < n; ++i) out[i] = combined(out[i], other[i]);
      }
    }
  }

  Bounds bounds() const override {
    Bounds all = operands_.front()->bounds();
    if (operation_ == Operation::subtract) return all;
    for (std::size_t k = 1; k < operands_.size(); ++k) {
      const Bounds next = operands_[k]->bounds();
      if (operation_ == Operation::intersect) {
        all = {all.min.cwiseMax(next.min), all.max.cwiseMin(next.max)};
      } else if (all.empty()) {
        all = next;
      } else if (!next.empty()) {
        all = {all.min.cwiseMin(next.min), all.max.cwiseMax(next.max)};
      }
    }
    return all;
  }

 private:
  double combined(double a, double b) const {
    if (operation_ == Operation::unite) return std::min(a, b);
    return std::max(a, operation_ == Operation::intersect ? b : -b);
  }

  Operation operation_;
  std::vector<ShapePtr> operands_;
};

ShapePtr make_combination(Operation operation, std::vector<ShapePtr> operands) {
  if (operands.size() == 1) return operands.front();
  return std::make_shared<Combination>(operation, std::move(operands));
}

}  // namespace

ShapePtr make_union(std::vector<ShapePtr> operands) {
  return make_combination(Operation::unite, std::move(operands));
}

ShapePtr make_intersection(std::vector<ShapePtr> operands) {
  return make_combination(Operation::intersect, std::move(operands));
}

ShapePtr make_difference(std::vector<ShapePtr> operands) {
  return make_combination(Operation::subtract, std::move(operands));
}

}  // namespace firn
