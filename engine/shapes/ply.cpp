#include "engine/shapes/ply.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

static_assert(std::endian::native == std::endian::little);

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Type> type_of(std::string_view name) {
  static const std::map<std::string_view, Type> types{
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
      {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
      {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
      {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
      {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
      {"float64", Type::float64}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

constexpr double kLongestPolygon = 1e5;

class Reader {
 public:
  Reader(std::span<const std::uint8_t> bytes, const std::string& file)
      : at_(reinterpret_cast<const char*>(bytes.data())), end_(at_ + bytes.size()), file_(file) {}

  PlyFile read() {
    read_header();
    for (const Element& element : elements_) read_element(element);
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    const bool has_lines = !binary_ || !in_body_;
    const std::string place = has_lines ? fmt::format("{}:{}", file_, line_) : file_;
    throw Error(ExitCode::input, place + ": " + why);
  }

  [[noreturn]] void fail_at_end() const {
    fail(fmt::format("the file ends at {} {} of {}", printable(element_->name), record_, element_->count));
  }

  std::string_view next_line() {
    if (at_ == end_) fail("the file ends in the middle");
    const char* newline =
        static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    const char* stop = newline ? newline : end_;
    std::string_view text(at_, static_cast<std::size_t>(stop - at_));
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    at_ = newline ? newline + 1 : end_;
    ++line_;
    return text;
  }

  void read_header() {
    if (next_line() != "ply") fail("is not a PLY file: its first line is not 'ply'");
    for (;;) {
      std::istringstream words{std::string(next_line())};
      std::string word;
      words >> word;
      if (word == "end_header") break;
      if (word == "format")
        read_format(words);
      else if (word == "element")
        read_element_line(words);
      else if (word == "property")
        read_property_line(words);
      else if (word != "comment" && word != "obj_info")
        fail(fmt::format("unknown word '{}' in the header", printable(word)));
    }
    in_body_ = true;
  }

  void read_format(std::istringstream& words) {
    std::string format;
    words >> format;
    if (format == "binary_little_endian")
      binary_ = true;
    else if (format != "ascii") {
      fail(fmt::format("format '{}' is not read; known: ascii, binary_little_endian", printable(format)));
    }
  }

  void read_element_line(std::istringstream& words) {
    Element element;
    if (!(words >> element.name >> element.count)) fail("expected 'element <name> <count>'");
    elements_.push_back(element);
  }

  void read_property_line(std::istringstream& words) {
    if (elements_.empty()) fail("a property before the first element");
    Property property;
    std::string type, count;
    words >> type;
    if (type == "list") {
      words >> count >> type;
      property.count = type_of(count);
      if (!property.count) fail(fmt::format("unknown type '{}'", printable(count)));
    }
    const std::optional<Type> known = type_of(type);
    if (!known) fail(fmt::format("unknown type '{}'", printable(type)));
    property.type = *known;
    if (!(words >> property.name)) fail("a property without a name");
    elements_.back().properties.push_back(property);
  }

  void read_element(const Element& element) {
    // Each record needs a byte at least, so a forged count cannot make us allocate.
    if (element.count > static_cast<std::uint64_t>(end_ - at_) ||
        (element.count > 0 && element.properties.empty())) {
      fail(fmt::format("the header announces {} of '{}', but the file has only {} bytes left", element.count,
                       printable(element.name), end_ - at_));
    }
    const bool vertex = element.name == "vertex";
    std::vector<std::vector<double>*> columns(element.properties.size(), nullptr);
    if (vertex) {
      result_.vertex_count = element.count;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (element.properties[k].count) continue;
        columns[k] = &result_.vertex[element.properties[k].name];
        if (!columns[k]->empty())
          fail(fmt::format("property '{}' twice", printable(element.properties[k].name)));
        columns[k]->reserve(element.count);
      }
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      begin_record(element, i);
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const Property& property = element.properties[k];
        if (property.count)
          read_list(property, element.name == "face" && is_index(property.name));
        else if (columns[k])
          columns[k]->push_back(number(property.type));
        else
          number(property.type);
      }
      end_record();
    }
  }

  static bool is_index(const std::string& name) { return name == "vertex_indices" || name == "vertex_index"; }

  void read_list(const Property& property, bool polygon) {
    const double count = number(*property.count);
    if (!(count >= 0 && count <= kLongestPolygon)) fail("a list with an impossible length");
    polygon_.clear();
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const double value = number(property.type);
      if (!polygon) continue;
      if (!(value >= 0 && value < 4294967296.0))
        fail(fmt::format("vertex index {} of a face is out of range", value));
      polygon_.push_back(static_cast<std::uint32_t>(value));
    }
    for (std::size_t i = 2; i < polygon_.size(); ++i) {
      result_.triangles.push_back({polygon_[0], polygon_[i - 1], polygon_[i]});
    }
  }

  void begin_record(const Element& element, std::uint64_t index) {
    element_ = &element;
    record_ = index + 1;
    if (binary_) return;
    if (at_ == end_) {
      ++line_;
      fail_at_end();
    }
    text_ = next_line();
  }

  void end_record() {
    if (!binary_ && text_.find_first_not_of(" \t") != std::string_view::npos)
      fail("more values than the header announces");
  }

  double number(Type type) { return binary_ ? binary_number(type) : text_number(); }

  double text_number() {
    text_.remove_prefix(std::min(text_.find_first_not_of(" \t"), text_.size()));
    if (text_.empty()) fail("fewer values than the header announces");
    if (text_.front() == '+') text_.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    const std::size_t used = static_cast<std::size_t>(stop - text_.data());
    if (error != std::errc() || (used < text_.size() && text_[used] != ' ' && text_[used] != '\t')) {
      fail(fmt::format("'{}' is not a number", printable(text_.substr(0, text_.find_first_of(" \t")), 30)));
    }
    text_.remove_prefix(used);
    return value;
  }

  template <class T>
  double raw() {
    if (static_cast<std::size_t>(end_ - at_) < sizeof(T)) fail_at_end();
    T value;
    std::memcpy(&value, at_, sizeof(T));
    at_ += sizeof(T);
    return static_cast<double>(value);
  }

  double binary_number(Type type) {
    switch (type) {
      case Type::int8:
        return raw<std::int8_t>();
      case Type::uint8:
        return raw<std::uint8_t>();
      case Type::int16:
        return raw<std::int16_t>();
      case Type::uint16:
        return raw<std::uint16_t>();
      case Type::int32:
        return raw<std::int32_t>();
      case Type::uint32:
        return raw<std::uint32_t>();
      case Type::float32:
        return raw<float>();
      case Type::float64:
        return raw<double>();
    }
    return 0;
  }

  const char* at_;
  const char* end_;
  const std::string& file_;
  int line_ = 0;
  bool binary_ = false, in_body_ = false;
  std::vector<Element> elements_;
  std::string_view text_;  // what is left of the record's line
  const Element* element_ = nullptr;
  std::uint64_t record_ = 0;  // 1-based, of *element_
  std::vector<std::uint32_t> polygon_;
  PlyFile result_;
};

}  // namespace

const std::vector<double>& PlyFile::column(const std::string& name, const std::string& file) const {
  const auto found = vertex.find(name);
  if (found != vertex.end()) return found->second;
  throw Error(ExitCode::input, fmt::format("{}: element 'vertex' has no property '{}'", file, name));
}

PlyFile read_ply(std::span<const std::uint8_t> bytes, const std::string& file) {
  return Reader(bytes, file).read();
}

}  // namespace firn
