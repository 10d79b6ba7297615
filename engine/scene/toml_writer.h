// The visitor of fields.h that writes a description as a commented TOML scene. A key is explained where it
// first stands; after that it is written only where it is not at its default.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "engine/scene/fields.h"

namespace firn {

class TomlWriter {
 public:
  /// Keys that were explained; shared by all tables of a text.
  using Explained = std::set<std::string>;

  /// A table with its header, such as "[simulation]", and all tables below it, whose headers start with
  /// `path`.
  template <class T>
  static std::string table(Explained& explained, std::string path, std::string header, T value) {
    Explained nothing_yet = explained;
    TomlWriter defaults(nothing_yet, path);
    T initial = defaults_of<T>();
    fields(defaults, initial);
    TomlWriter writer(explained, path);
    fields(writer, value);
    return writer.finish(header, defaults);
  }

  template <class T>
  void real(const Key& key, const T& value, const Range& range);
  template <class T>
  void integer(const Key& key, const T& value, const IntegerRange& range) {
    const bool open = range.max == IntegerRange{0}.max;
    add(key, std::to_string(value), open ? "" : fmt::format("{} to {}", range.min, range.max));
  }
  template <class E, std::size_t n>
  void choice(const Key& key, E value, const std::array<Choice<E>, n>& choices);
  void text(const Key& key, const std::string& value) { add(key, quote(value)); }
  void name(const Key& key, const Name& value) { add(key, quote(value.text)); }
  void file(const Key& key, const Name& value) { add(key, quote(value.text)); }
  void file(const Key& key, const std::optional<Name>& value) { add(key, value ? quote(value->text) : ""); }
  void vector(const Key& key, const Vec3& value, Axes = Axes::along);
  void quantities(const Key& key, const VectorQuantity& value, std::span<const std::string_view> names);
  void attributes(const Key& key, const std::vector<Name>& value);
  void model(const Key& key, MaterialDescription& value);
  void kind(const Key& key, ShapeDescription::Kind& value);
  template <class S>
  void shape(const Key& key, const S& value) {
    section(key, value);
  }
  void shapes(const Key& key, const std::vector<ShapeDescription>& value) { list(key, value); }
  void materials(const Key& key, const std::vector<MaterialDescription>& value);
  template <class T>
  void section(const Key& key, const T& value);
  template <class T>
  void section(const Key& key, const std::optional<T>& value) {
    if (value) section(key, *value);
  }
  template <class T>
  void list(const Key& key, const std::vector<T>& value);

 private:
  struct Line {
    std::string key, value, comment;
    bool live, required;
  };

  TomlWriter(Explained& explained, std::string path) : explained_(explained), path_(std::move(path)) {}

  static std::string quote(std::string_view text);
  std::string below(std::string_view key) const;
  void add(const Key& key, const std::string& value, std::string_view allowed = {});
  bool explain(const Key& key);
  void add_table(const Key& key, std::string_view text);
  std::string finish(const std::string& header, const TomlWriter& defaults) const;

  Explained& explained_;
  std::string path_;
  std::vector<Line> lines_;
  std::string tables_;  // TOML wants them after the keys of their parent
};

template <class T>
void TomlWriter::real(const Key& key, const T& value, const Range& range) {
  std::string text;
  if constexpr (std::is_same_v<T, double>) {
    text = fmt::format("{}", value);
  } else if (value) {
    text = fmt::format("{}", *value);
  }
  add(key, text, range.text() == "any number" ? "" : range.text());
}

template <class E, std::size_t n>
void TomlWriter::choice(const Key& key, E value, const std::array<Choice<E>, n>& choices) {
  std::string chosen, allowed;
  for (const Choice<E>& c : choices) {
    if (c.value == value) chosen = quote(c.word);
    allowed += fmt::format("{}{} ({})", allowed.empty() ? "" : ", ", quote(c.word), c.meaning);
  }
  add(key, chosen, allowed);
}

template <class T>
void TomlWriter::section(const Key& key, const T& value) {
  const std::string path = below(key.name);
  add_table(key, table(explained_, path, "[" + path + "]", value));
}

template <class T>
void TomlWriter::list(const Key& key, const std::vector<T>& value) {
  const std::string path = below(key.name);
  for (const T& element : value) add_table(key, table(explained_, path, "[[" + path + "]]", element));
}

}  // namespace firn
