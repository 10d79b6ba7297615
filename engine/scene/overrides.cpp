#include "engine/scene/overrides.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/base/nearest_name.h"
#include "engine/scene/scene_text.h"

namespace firn {
namespace {

// The value as a TOML string, for words that are not TOML by themselves.
std::string as_toml_string(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of(" \t"), word.size()));
  std::string out = "\"";
  for (char c : word) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

// The override as the scene it would be alone: tables of one key each, down to the value.
// `removes`: nothing stands after its sign of equality.
std::optional<toml::table> parse_override(const std::string& text, const std::string& source, Report& report,
                                          bool& removes) {
  const std::size_t equals = text.find('=');
  const bool printing =
      std::none_of(text.begin(), text.end(), [](char c) { return c >= '\0' && c < ' ' && c != '\t'; });
  if (equals == std::string::npos || !printing) {
    report.add({source, 0, 0}, "", "found no KEY=VALUE on one line; allowed: as in simulation.cfl=0.2");
    return std::nullopt;
  }
  removes = text.find_first_not_of(" \t", equals + 1) == std::string::npos;
  if (removes) return parse_toml(text.substr(0, equals) + "=0", source, report);
  Report ignored(report.file());
  if (auto table = parse_toml(text, source, ignored)) return table;
  return parse_toml(text.substr(0, equals + 1) + as_toml_string(text.substr(equals + 1)), source, report);
}

// The value itself, or a table that a part of the dotted key stands for.
bool is_path(const toml::node& node) {
  return node.is_table() && !node.as_table()->is_inline();
}

std::optional<std::string_view> name_of(const toml::node& element) {
  const toml::table* table = element.as_table();
  const toml::value<std::string>* name = table ? table->get_as<std::string>("name") : nullptr;
  return name ? std::optional<std::string_view>(name->get()) : std::nullopt;
}

toml::node* find_element(toml::array& array, std::string_view key) {
  for (toml::node& element : array) {
    if (name_of(element) == key) return &element;
  }
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), index);
  const bool whole = error == std::errc() && end == key.data() + key.size();
  return whole ? array.get(index) : nullptr;
}

std::string no_element(const toml::array& array, std::string_view key) {
  std::vector<std::string> known;
  for (std::size_t i = 0; i < array.size() && i < 20; ++i) {
    const auto name = name_of(array[i]);
    known.push_back(name ? printable(*name) : std::to_string(i));
  }
  return fmt::format("found no element '{}'; there are {}: {}", printable(key), array.size(),
                     fmt::join(known, ", "));
}

class Merge {
 public:
  Merge(std::string source, bool removes, Report& report)
      : source_(std::move(source)), removes_(removes), report_(report) {}

  // `change` has one key.
  void into(toml::node& target, toml::table& change) {
    const toml::key key = change.begin()->first;
    toml::node& value = change.begin()->second;
    path_ += (path_.empty() ? "" : ".") + printable(key.str());
    if (toml::array* array = target.as_array()) {
      into_element(*array, key, value);
    } else {
      into_table(*target.as_table(), key, value);
    }
  }

 private:
  void into_table(toml::table& table, const toml::key& key, toml::node& value) {
    toml::node* old = table.get(key);
    if (old && is_path(value) && (old->is_table() || old->is_array())) return into(*old, *value.as_table());
    // Erased first, so that the key, too, says that it came from the command line.
    table.erase(key.str());
    if (removes_) return;
    value.visit([&](auto& concrete) { table.insert(key, std::move(concrete)); });
  }

  void into_element(toml::array& array, const toml::key& key, toml::node& value) {
    toml::node* old = find_element(array, key.str());
    if (!old) return report_.add({source_, 0, 0}, path_, no_element(array, key.str()));
    if (is_path(value) && (old->is_table() || old->is_array())) return into(*old, *value.as_table());
    const auto index =
        std::find_if(array.begin(), array.end(), [&](toml::node& element) { return &element == old; });
    if (removes_) return void(array.erase(index));
    value.visit([&](auto& concrete) { array.replace(index, std::move(concrete)); });
  }

  std::string source_;
  bool removes_;
  Report& report_;
  std::string path_;
};

}  // namespace

void apply_override(const std::string& text, toml::table& scene, Report& report) {
  const std::string source = "--set " + printable(text, 200);
  bool removes = false;
  if (auto change = parse_override(text, source, report, removes))
    Merge(source, removes, report).into(scene, *change);
}

}  // namespace firn
