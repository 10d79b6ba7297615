#include "engine/base/formula.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <muParser.h>

#include "engine/base/nearest_name.h"

namespace firn {
namespace {

// Operators are kept in a stack by the parser, so this bounds time, not depth.
constexpr std::size_t kLongest = 4096;

/// It would let a formula change its own names.
bool assigns(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
    } else if (i == 0 || std::string_view("<>!").find(text[i - 1]) == std::string_view::npos) {
      return true;
    }
  }
  return false;
}

}  // namespace

struct Formula::Parser {
  Parser(const std::string& formula, std::span<const std::string_view> with)
      : text(formula), names(with.begin(), with.end()), values(names.size()) {
    if (text.size() > kLongest) throw FormulaError(fmt::format("longer than {} characters", kLongest));
    if (assigns(text)) throw FormulaError("'=' stands for nothing here; to compare, write ==");
    try {
      parser.ClearConst();
      parser.DefineConst("pi", std::numbers::pi);
      for (std::size_t i = 0; i < names.size(); ++i) parser.DefineVar(names[i], &values[i]);
      parser.SetExpr(text);
      int results = 0;
      parser.Eval(results);
      if (results != 1) throw FormulaError("several values, separated by commas");
    } catch (const mu::ParserError& error) {
      std::string why = printable(error.GetMsg(), 200);
      if (why.ends_with('.')) why.pop_back();
      throw FormulaError(why);
    }
  }
  Parser(const Parser& other) : Parser(other.text, views(other.names)) {}
  Parser& operator=(const Parser&) = delete;

  static std::vector<std::string_view> views(const std::vector<std::string>& names) {
    return {names.begin(), names.end()};
  }

  std::string text;
  std::vector<std::string> names;
  std::vector<double> values;  // what the parser's variables point at
  mu::Parser parser;
};

Formula::Formula(const std::string& text, std::span<const std::string_view> names)
    : parser_(std::make_unique<Parser>(text, names)) {}
Formula::Formula(const Formula& other) : parser_(std::make_unique<Parser>(*other.parser_)) {}
Formula& Formula::operator=(const Formula& other) {
  parser_ = std::make_unique<Parser>(*other.parser_);
  return *this;
}
Formula::~Formula() = default;

double Formula::operator()(std::span<const double> values) const {
  std::copy(values.begin(), values.end(), parser_->values.begin());
  return parser_->parser.Eval();
}

std::string_view formula_words() {
  return "pi, sqrt, exp, ln, log10, abs, sign, min, max, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, "
         "tanh";
}

}  // namespace firn
