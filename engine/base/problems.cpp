#include "engine/base/problems.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "engine/base/error.h"

namespace firn {

void Problems::add(SourceMark mark, std::string key, std::string message) {
  problems_.push_back({std::move(mark), std::move(key), std::move(message)});
}

std::string Problems::text() const {
  auto sorted = problems_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) {
    return std::tie(a.mark.file, a.mark.line, a.mark.column) <
           std::tie(b.mark.file, b.mark.line, b.mark.column);
  });
  std::string out;
  for (const Problem& p : sorted) {
    if (!out.empty()) out += '\n';
    out += p.mark.line > 0 ? fmt::format("{}:{}:{}: ", p.mark.file, p.mark.line, p.mark.column)
                           : fmt::format("{}: ", p.mark.file);
    if (!p.key.empty()) out += p.key + ": ";
    out += p.message;
  }
  return out;
}

void Problems::throw_if_any() const {
  if (!empty()) throw Error(ExitCode::input, text());
}

}  // namespace firn
