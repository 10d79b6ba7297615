#include "tools/cli/study/page.h"

#include <map>
#include <string_view>

#include "engine/base/check.h"

// Made of the files in tools/study/page and of Chart.js by page_parts.S.
extern "C" {
extern const char firn_page_html[], firn_page_html_end[];
extern const char firn_page_style[], firn_page_style_end[];
extern const char firn_page_script[], firn_page_script_end[];
extern const char firn_page_chart[], firn_page_chart_end[];
}

namespace firn {
namespace {

std::string_view part(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

/// A title may spell anything, the end of a script or the start of a comment among it.
std::string without_markup(const std::string& json) {
  std::string out;
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

}  // namespace

std::string assemble_page(const std::string& json) {
  const std::string data = without_markup(json);
  const std::map<std::string_view, std::string_view> parts{
      {"@STYLE@", part(firn_page_style, firn_page_style_end)},
      {"@CHART@", part(firn_page_chart, firn_page_chart_end)},
      {"@DATA@", data},
      {"@SCRIPT@", part(firn_page_script, firn_page_script_end)}};
  // Once from front to back: what is put in is not looked at again.
  std::string_view rest = part(firn_page_html, firn_page_html_end);
  std::string out;
  for (std::size_t left = parts.size(); left > 0; --left) {
    const std::size_t begin = rest.find('@'), end = rest.find('@', begin + 1) + 1;
    const auto found = parts.find(rest.substr(begin, end - begin));
    FIRN_CHECK(found != parts.end());
    out.append(rest.substr(0, begin)).append(found->second);
    rest.remove_prefix(end);
  }
  return out.append(rest);
}

}  // namespace firn
