// A number that a user gives as a formula, such as "0.1 * sin(pi * x / 2)".
//
// Operators + - * / ^, comparisons, ?: and parentheses; the constant pi; the functions that formula_words()
// lists. Which names stand for numbers, a formula's key says.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace firn {

/// What is wrong with a formula, and where.
class FormulaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Evaluates one formula. Not for several threads at once: each takes a copy.
class Formula {
 public:
  /// Throws FormulaError when `text` is no formula of `names`.
  Formula(const std::string& text, std::span<const std::string_view> names);
  Formula(const Formula& other);
  Formula& operator=(const Formula& other);
  ~Formula();

  /// One value for each name, in their order. Not finite where the formula is not defined.
  double operator()(std::span<const double> values) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// What a message lists beside a key's own names: "pi, sqrt, exp, ...".
std::string_view formula_words();

}  // namespace firn
