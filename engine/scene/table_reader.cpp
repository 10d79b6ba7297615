#include "engine/scene/table_reader.h"

#include <cmath>

#include "engine/base/nearest_name.h"

namespace firn {

std::string allowed_number(const Range& range, std::string_view unit) {
  const std::string text = range.text();
  const std::string number = text == "any number" ? text : "a number " + text;
  return unit == "-" ? number : fmt::format("{} ({})", number, unit);
}

bool TableReader::good(std::initializer_list<std::string_view> keys) const {
  return std::none_of(keys.begin(), keys.end(), [&](std::string_view key) { return bad_.contains(key); });
}

void TableReader::report(std::string_view path, std::string message) {
  bad_.emplace(path);
  if (path.empty()) return context_.report.add(table_.source(), path_, std::move(message));
  const toml::node* node = table_.at_path(path).node();
  context_.report.add(node ? node->source() : table_.source(), below(path), std::move(message));
}

void TableReader::report_unknown_keys() const {
  for (const auto& [key, value] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    const bool full = context_.report.full();
    context_.report.add(key.source(), below(printable(key.str())),
                        full ? std::string() : unknown_name("key", key.str(), known_));
  }
}

std::string TableReader::below(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TableReader::learn(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
}

const toml::node* TableReader::find(const Key& key, std::string_view allowed) {
  learn(key.name);
  if (only_learn_) return nullptr;
  const toml::node* node = table_.get(key.name);
  if (!node && key.need == Need::required) {
    bad_.emplace(key.name);
    context_.report.add(table_.source(), below(key.name), fmt::format("missing; required: {}", allowed));
  }
  return node;
}

void TableReader::refuse(std::string_view key, const toml::node& node, std::string_view allowed) {
  refuse(key, node, "", found_and_allowed(node, allowed));
}

void TableReader::refuse(std::string_view key, const toml::node& node, std::string_view element,
                         std::string message) {
  bad_.emplace(key);
  context_.report.add(node.source(), below(key).append(element), std::move(message));
}

std::optional<double> TableReader::read_real(std::string_view key, const toml::node& node,
                                             std::string_view allowed, const Range& range) {
  const auto value = node.is_integer()          ? static_cast<double>(node.as_integer()->get())
                     : node.is_floating_point() ? node.as_floating_point()->get()
                                                : std::numeric_limits<double>::quiet_NaN();
  if (range.allows(value)) return value;
  refuse(key, node, allowed);
  return std::nullopt;
}

std::optional<std::int64_t> TableReader::read_integer(const Key& key, const IntegerRange& range) {
  const bool open = range.max == std::numeric_limits<std::int64_t>::max();
  const std::string allowed = open ? fmt::format("an integer >= {}", range.min)
                                   : fmt::format("an integer from {} to {}", range.min, range.max);
  const toml::node* node = find(key, allowed);
  if (!node) return std::nullopt;
  const auto value = node->is_integer() ? std::optional(node->as_integer()->get()) : std::nullopt;
  if (value && *value >= range.min && *value <= range.max) return value;
  refuse(key.name, *node, allowed);
  return std::nullopt;
}

std::optional<Name> TableReader::read_text(const Key& key, std::string_view allowed) {
  const toml::node* node = find(key, allowed);
  if (!node) return std::nullopt;
  if (node->is_string()) return Name{node->as_string()->get(), context_.report.mark(node->source())};
  refuse(key.name, *node, allowed);
  return std::nullopt;
}

std::optional<Name> TableReader::read_file(const Key& key) {
  auto file = read_text(key, "a file name in quotes");
  if (!file) return file;
  const std::filesystem::path path = std::filesystem::path(file->text).lexically_normal();
  const bool inside = path.is_relative() && !path.empty() && *path.begin() != ".." && path.has_filename();
  // A scene from elsewhere must not be able to have just any file opened, nor one whose name ends at a NUL.
  if (inside && path != "." && file->text.find('\0') == std::string::npos) return file;
  refuse(key.name, *table_.get(key.name), "a file below the folder of the scene");
  return std::nullopt;
}

std::optional<std::size_t> TableReader::read_word(const Key& key, std::span<const std::string_view> words) {
  std::string allowed;
  for (std::string_view word : words) allowed += fmt::format("{}\"{}\"", allowed.empty() ? "" : ", ", word);
  const auto written = read_text(key, "one of " + allowed);
  if (!written) return std::nullopt;
  const auto found = std::find(words.begin(), words.end(), written->text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  refuse(key.name, *table_.get(key.name), "", unknown_name(key.name, written->text, words));
  return std::nullopt;
}

const toml::table* TableReader::read_table(const Key& key) {
  const toml::node* node = find(key, "a table");
  if (node && !node->is_table()) refuse(key.name, *node, "a table");
  return node ? node->as_table() : nullptr;
}

const toml::array* TableReader::read_array(const Key& key, std::string_view allowed, std::size_t least) {
  const std::string whole =
      least == 0 ? std::string(allowed) : fmt::format("{}, at least {}", allowed, least);
  const toml::node* node = find(key, whole);
  if (!node) return nullptr;
  const toml::array* array = node->as_array();
  if (array && array->size() >= least) return array;
  refuse(key.name, *node, whole);
  return nullptr;
}

}  // namespace firn
