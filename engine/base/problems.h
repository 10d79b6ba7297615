// The list of everything that is wrong with a user's input, gathered in one pass and shown at once.
#pragma once

#include <string>
#include <vector>

namespace firn {

/// Where a value stands in a text the user wrote. `file` may also be an option, as in "--set
/// simulation.cfl=2".
struct SourceMark {
  std::string file;
  int line = 0;  // 1-based; 0: the whole file
  int column = 0;
};

/// One mistake: "file:line:column: key: what was found; what is allowed".
struct Problem {
  SourceMark mark;
  std::string key;      // dotted path of the value, as in "bodies[0].shape.radius"; empty for syntax errors
  std::string message;  // what was found and what is allowed
};

class Problems {
 public:
  void add(SourceMark mark, std::string key, std::string message);
  bool empty() const { return problems_.empty(); }
  std::size_t size() const { return problems_.size(); }
  const std::vector<Problem>& all() const { return problems_; }

  /// One line a problem, in the order of the text.
  std::string text() const;

  /// Throws Error{ExitCode::input, text()} unless empty.
  void throw_if_any() const;

 private:
  std::vector<Problem> problems_;
};

}  // namespace firn
