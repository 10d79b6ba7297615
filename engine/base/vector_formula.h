// Three numbers or formulas: a vector that depends on place or time.
#pragma once

#include <array>
#include <optional>

#include "engine/base/formula.h"

namespace firn {

/// As it is written: a number, or a formula where that is not empty.
struct Quantity {
  double number = 0;
  std::string formula;

  friend bool operator==(const Quantity&, const Quantity&) = default;
};
using VectorQuantity = std::array<Quantity, 3>;

/// Evaluates one. Not for several threads at once: each takes a copy.
class VectorFormula {
 public:
  /// Throws FormulaError.
  VectorFormula(const VectorQuantity& quantity, std::span<const std::string_view> names) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      number_[axis] = quantity[axis].number;
      if (!quantity[axis].formula.empty()) formula_[axis].emplace(quantity[axis].formula, names);
    }
  }

  bool constant() const { return !formula_[0] && !formula_[1] && !formula_[2]; }

  /// One value for each name, in their order.
  std::array<double, 3> operator()(std::span<const double> values) const {
    std::array<double, 3> out = number_;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (formula_[axis]) out[axis] = (*formula_[axis])(values);
    return out;
  }

 private:
  std::array<double, 3> number_;
  std::array<std::optional<Formula>, 3> formula_;
};

}  // namespace firn
