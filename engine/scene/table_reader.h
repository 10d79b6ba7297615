// The visitor of fields.h that fills a description from one TOML table and reports what is wrong with it.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "engine/scene/fields.h"
#include "engine/scene/report.h"
#include "materials/model_info.h"
#include "materials/presets.h"

namespace firn {

class TableReader {
 public:
  /// What the readers of all tables of a scene share.
  struct Context {
    Report& report;
    std::optional<int> dimension;  // once it is read, and allowed
    bool needs_density = true;     // of a material that has no default
  };

  /// `path`: dotted key of the table, empty for the whole scene.
  TableReader(Context& context, const toml::table& table, std::string path)
      : context_(context), table_(table), path_(std::move(path)) {}

  // One for each kind of key (see fields.h).
  template <class T>
  void real(const Key& key, T& out, const Range& range);
  template <class T>
  void integer(const Key& key, T& out, const IntegerRange& range);
  template <class E, std::size_t n>
  void choice(const Key& key, E& out, const std::array<Choice<E>, n>& choices);
  void text(const Key& key, std::string& out);
  void name(const Key& key, Name& out);
  template <class T>
  void file(const Key& key, T& out);
  void vector(const Key& key, Vec3& out, Axes axes = Axes::along);
  void quantities(const Key& key, VectorQuantity& out, std::span<const std::string_view> names);
  void attributes(const Key& key, std::vector<Name>& out);
  void model(const Key& key, MaterialDescription& out);
  void kind(const Key& key, ShapeDescription::Kind& out);
  template <class S>
  void shape(const Key& key, S& out) {
    section(key, out);
  }
  void shapes(const Key& key, std::vector<ShapeDescription>& out);
  void materials(const Key& key, std::vector<MaterialDescription>& out);
  template <class T>
  void section(const Key& key, T& out);
  template <class T>
  void list(const Key& key, std::vector<T>& out);

  /// Every key that no call above has named is a mistake.
  void report_unknown_keys() const;

  // For checks that tie several keys together (checks.h).
  Context& context() { return context_; }
  bool has(std::string_view key) const { return table_.contains(key); }
  /// None of these keys had a mistake, nor is a required one missing.
  bool good(std::initializer_list<std::string_view> keys) const;
  bool good() const { return bad_.empty(); }
  /// At the value of `path` below this table, such as "keyframes[2].time"; empty: at the table itself.
  void report(std::string_view path, std::string message);

 private:
  std::string below(std::string_view key) const;
  const toml::node* find(const Key& key, std::string_view allowed);
  void refuse(std::string_view key, const toml::node& node, std::string_view allowed);
  void refuse(std::string_view key, const toml::node& node, std::string_view element, std::string message);

  const toml::array* read_three(const Key& key, std::string_view allowed);
  bool check_axis(const Key& key, const toml::node& node, bool zero, Axes axes, int axis);
  std::optional<double> read_real(std::string_view key, const toml::node& node, std::string_view allowed,
                                  const Range& range);
  std::optional<std::int64_t> read_integer(const Key& key, const IntegerRange& range);
  std::optional<Name> read_text(const Key& key, std::string_view allowed);
  std::optional<Name> read_file(const Key& key);
  /// Index of the word written, one of `words`.
  /// Null where there is none, which is reported.
  const ModelInfo* read_model(const Key& key);
  const Preset* read_preset(const Key& model_key);
  /// Of a model; empty where the scene leaves it out, as it may if there is a value already, or is refused.
  std::optional<double> read_parameter(const Parameter& p, bool has_value);
  std::optional<std::size_t> read_word(const Key& key, std::span<const std::string_view> words);
  const toml::table* read_table(const Key& key);
  const toml::array* read_array(const Key& key, std::string_view allowed, std::size_t least);
  template <class T>
  void read_list(const Key& key, std::string_view allowed, std::size_t least, std::vector<T>& out);
  void learn(std::string_view key);
  void learn_every_model();
  void learn_every_shape();

  Context& context_;
  const toml::table& table_;
  std::string path_;
  std::vector<std::string_view> known_;
  std::set<std::string, std::less<>> bad_;
  bool only_learn_ = false;  // what keys there are, when which of them apply cannot be told
};

/// "a number > 0 (m)"
std::string allowed_number(const Range& range, std::string_view unit);

}  // namespace firn

#include "engine/scene/table_reader_impl.h"
