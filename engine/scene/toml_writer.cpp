#include "engine/scene/toml_writer.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "engine/scene/attributes.h"
#include "engine/scene/shape_types.h"
#include "materials/model_info.h"

namespace firn {

std::string TomlWriter::quote(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string TomlWriter::below(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

bool TomlWriter::explain(const Key& key) {
  return explained_.insert(fmt::format("{}: {}", key.name, key.meaning)).second;
}

void TomlWriter::add(const Key& key, const std::string& value, std::string_view allowed) {
  std::string comment;
  if (explain(key)) {
    const std::string unit = key.unit == "-" ? "" : fmt::format(" ({})", key.unit);
    const std::string need = key.need == Need::required ? "; required" : "";
    comment = fmt::format("{}{}{}{}{}", key.meaning, unit, allowed.empty() ? "" : ": ", allowed, need);
  }
  const bool live = !value.empty();
  lines_.push_back({std::string(key.name), live ? value : std::string(key.sample), comment, live,
                    key.need == Need::required});
}

void TomlWriter::vector(const Key& key, const Vec3& value, Axes) {
  add(key, fmt::format("[{}, {}, {}]", value[0], value[1], value[2]));
}

void TomlWriter::quantities(const Key& key, const VectorQuantity& value, std::span<const std::string_view>) {
  std::array<std::string, 3> words;
  std::transform(value.begin(), value.end(), words.begin(), [](const Quantity& q) {
    return q.formula.empty() ? fmt::format("{}", q.number) : quote(q.formula);
  });
  add(key, fmt::format("[{}]", fmt::join(words, ", ")));
}

void TomlWriter::attributes(const Key& key, const std::vector<Name>& value) {
  std::vector<std::string> words, known;
  for (const Name& name : value) words.push_back(quote(name.text));
  for (const Attribute& a : kAttributes) known.push_back(fmt::format("{} ({})", a.name, a.meaning));
  add(key, fmt::format("[{}]", fmt::join(words, ", ")), fmt::format("{}", fmt::join(known, ", ")));
}

void TomlWriter::model(const Key& key, MaterialDescription& value) {
  add(key, quote(value.model.text));
  const ModelInfo* model = find_model(value.model.text);
  if (!model) return;
  for (const Parameter& p : model->parameters) {
    const auto found = value.parameters.find(std::string(p.name));
    const Need need = p.required() ? Need::required : Need::optional;
    const double number =
        found == value.parameters.end() ? p.default_value : std::get<double>(found->second.value);
    const Key parameter = {p.name, need, p.meaning, p.unit};
    if (p.choices.empty()) {
      real(parameter, number, Range::of(p));
    } else {
      add(parameter, p.text(number), p.range());
    }
  }
}

void TomlWriter::kind(const Key& key, ShapeDescription::Kind& value) {
  const ShapeType& type = type_of(value);
  add({key.name, key.need, type.meaning}, quote(type.word));
  std::visit([&](auto& kind) { fields(*this, kind); }, value);
}

void TomlWriter::materials(const Key& key, const std::vector<MaterialDescription>& value) {
  for (const MaterialDescription& material : value) {
    const std::string path = below(key.name) + "." + material.name;
    add_table(key, table(explained_, path, "[" + path + "]", material));
  }
}

void TomlWriter::add_table(const Key& key, std::string_view text) {
  tables_ += '\n';
  if (explain(key)) tables_ += fmt::format("# {}\n", key.meaning);
  tables_ += text;
}

namespace {

// As comment lines of a width that fits most windows.
std::string wrap(std::string_view text) {
  constexpr std::size_t kWidth = 108;
  std::string out;
  while (text.size() > kWidth) {
    const std::size_t cut = std::min(text.rfind(' ', kWidth), text.size());
    out += fmt::format("# {}\n", text.substr(0, cut));
    text.remove_prefix(std::min(cut + 1, text.size()));
  }
  return out + fmt::format("# {}\n", text);
}

}  // namespace

std::string TomlWriter::finish(const std::string& header, const TomlWriter& defaults) const {
  constexpr std::size_t kCommentColumn = 36, kLongestComment = 74;
  std::string out = header.empty() ? "" : header + "\n";
  for (const Line& line : lines_) {
    const bool at_default = std::any_of(
        defaults.lines_.begin(), defaults.lines_.end(),
        [&](const Line& initial) { return initial.key == line.key && initial.value == line.value; });
    if (line.comment.empty() && !line.required && at_default) continue;
    const std::string text = fmt::format("{}{} = {}", line.live ? "" : "#", line.key, line.value);
    if (line.comment.empty()) {
      out += text + "\n";
    } else if (text.size() < kCommentColumn && line.comment.size() < kLongestComment) {
      out += fmt::format("{:<{}}# {}\n", text, kCommentColumn, line.comment);
    } else {
      out += wrap(line.comment) + text + "\n";
    }
  }
  return out + tables_;
}

}  // namespace firn
