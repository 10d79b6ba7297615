// The templates of table_reader.h.
#pragma once

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "engine/scene/checks.h"
#include "engine/scene/table_reader.h"

namespace firn {

/// A whole table, with all that is wrong with it.
template <class T>
bool read_all(TableReader::Context& context, const toml::table& table, std::string path, T& out) {
  if constexpr (requires { out.mark; }) out.mark = context.report.mark(table.source());
  TableReader reader(context, table, std::move(path));
  fields(reader, out);
  check(reader, out);
  reader.report_unknown_keys();
  return reader.good();
}

namespace detail {
/// The value to fill, made first if it is an optional one.
template <class T>
T& emplace(T& value) {
  return value;
}
template <class T>
T& emplace(std::optional<T>& value) {
  return value.emplace();
}
}  // namespace detail

template <class T>
void TableReader::real(const Key& key, T& out, const Range& range) {
  const std::string allowed = allowed_number(range, key.unit);
  const toml::node* node = find(key, allowed);
  if (!node) return;
  if (const auto value = read_real(key.name, *node, allowed, range)) out = *value;
}

template <class T>
void TableReader::integer(const Key& key, T& out, const IntegerRange& range) {
  if (const auto value = read_integer(key, range)) out = static_cast<T>(*value);
}

template <class E, std::size_t n>
void TableReader::choice(const Key& key, E& out, const std::array<Choice<E>, n>& choices) {
  std::array<std::string_view, n> words;
  std::transform(choices.begin(), choices.end(), words.begin(), [](const Choice<E>& c) { return c.word; });
  if (const auto index = read_word(key, words)) out = choices[*index].value;
}

template <class T>
void TableReader::file(const Key& key, T& out) {
  if (auto value = read_file(key)) out = std::move(*value);
}

template <class T>
void TableReader::section(const Key& key, T& out) {
  const toml::table* table = read_table(key);
  if (table && !read_all(context_, *table, below(key.name), detail::emplace(out))) bad_.emplace(key.name);
}

template <class T>
void TableReader::list(const Key& key, std::vector<T>& out) {
  read_list(key, "an array of tables", key.need == Need::required ? 1 : 0, out);
}

template <class T>
void TableReader::read_list(const Key& key, std::string_view allowed, std::size_t least,
                            std::vector<T>& out) {
  const toml::array* array = read_array(key, allowed, least);
  if (!array) return;
  for (std::size_t i = 0; i < array->size(); ++i) {
    const toml::node& node = (*array)[i];
    const std::string element = fmt::format("[{}]", i);
    T& item = out.emplace_back();
    if (!node.is_table()) {
      refuse(key.name, node, element, found_and_allowed(node, "a table"));
    } else if (!read_all(context_, *node.as_table(), below(key.name) + element, item)) {
      bad_.emplace(key.name);
    }
  }
}

}  // namespace firn
