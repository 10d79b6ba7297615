#include "engine/scene/report.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {

void Report::add(SourceMark mark, std::string key, std::string message) {
  if (full()) {
    ++left_out_;
  } else {
    problems_.add(std::move(mark), std::move(key), std::move(message));
  }
}

SourceMark Report::mark(const toml::source_region& where) const {
  if (where.path && *where.path != file_) return {*where.path, 0, 0};
  return {file_, static_cast<int>(where.begin.line), static_cast<int>(where.begin.column)};
}

void Report::throw_if_any() const {
  if (left_out_ == 0) return problems_.throw_if_any();
  throw Error(ExitCode::input,
              fmt::format("{}\n{}: and {} more mistakes", problems_.text(), file_, left_out_));
}

namespace {

// With a point, so that 2.0 is seen to be no integer.
std::string real_text(double x) {
  const std::string text = fmt::format("{}", x);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

std::string describe(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::string:
      return fmt::format("the string '{}'", printable(node.as_string()->get()));
    case toml::node_type::integer:
      return fmt::format("the integer {}", node.as_integer()->get());
    case toml::node_type::floating_point:
      return "the number " + real_text(node.as_floating_point()->get());
    case toml::node_type::boolean:
      return node.as_boolean()->get() ? "true" : "false";
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array: {
      const std::size_t size = node.as_array()->size();
      return size == 1 ? "an array of 1 value" : fmt::format("an array of {} values", size);
    }
    default:
      return "a date or time";
  }
}

std::string found_and_allowed(const toml::node& found, std::string_view allowed) {
  return fmt::format("found {}; allowed: {}", describe(found), allowed);
}

}  // namespace firn
