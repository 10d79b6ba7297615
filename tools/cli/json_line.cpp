#include "tools/cli/json_line.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

// Brackets outside of strings; the parser recurses once for each level, and destroying its result again.
int nesting(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false, escaped = false;
  for (char c : text) {
    if (in_string) {
      in_string = escaped || c != '"';
      escaped = !escaped && c == '\\';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

// "[json.exception.parse_error.101] parse error at line 1, column 5: ..." without what only a programmer
// reads.
std::string plain(std::string_view what) {
  for (std::string_view cut : {"] ", "parse error at line 1, "}) {
    const std::size_t at = what.find(cut);
    if (at != std::string_view::npos) what.remove_prefix(at + cut.size());
  }
  return "not valid JSON: " + printable(what, 200);
}

}  // namespace

bool read_bounded_line(std::istream& in, std::string& line) {
  line.clear();
  std::streambuf& buffer = *in.rdbuf();
  int c = buffer.sbumpc();
  if (c == std::char_traits<char>::eof()) return false;
  for (; c != std::char_traits<char>::eof() && c != '\n'; c = buffer.sbumpc())
    if (line.size() <= kLongestJsonLine) line += static_cast<char>(c);
  return true;
}

nlohmann::json parse_json_line(std::string_view line) {
  using json = nlohmann::json;
  if (line.size() > kLongestJsonLine)
    throw Error(ExitCode::input, fmt::format("the line is longer than {} bytes", kLongestJsonLine));
  if (nesting(line) > kDeepestJson)
    throw Error(ExitCode::input, fmt::format("nested more than {} levels deep", kDeepestJson));
  std::vector<std::set<std::string>> keys;
  const auto refuse_duplicates = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw Error(ExitCode::input,
                  fmt::format("key '{}' is given twice", printable(value.get<std::string>())));
    return true;
  };
  try {
    return json::parse(line, refuse_duplicates);
  } catch (const json::exception& e) {
    throw Error(ExitCode::input, plain(e.what()));
  }
}

}  // namespace firn
