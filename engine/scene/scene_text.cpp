#include "engine/scene/scene_text.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/scene/key_depth.h"

namespace firn {
namespace {

constexpr std::size_t kLargestFile = std::size_t{16} << 20;

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view why) {
  throw Error(ExitCode::input, fmt::format("{}: {}", shown_path(path), why));
}

}  // namespace

std::string shown_path(const std::filesystem::path& path) {
  return printable(path.string(), 4096);
}

std::string read_scene_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) refuse(path, "no such file");
  if (error) refuse(path, "cannot be read: " + error.message());
  // Opening a pipe would wait for a writer, and a device may have no end.
  if (!std::filesystem::is_regular_file(status))
    refuse(path, "found no regular file; allowed: a scene in TOML");

  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "cannot be read: " + std::generic_category().message(errno));
  std::string text(kLargestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) refuse(path, "cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestFile) refuse(path, "found a file of more than 16 MiB; allowed: a scene in TOML");
  return text;
}

std::optional<toml::table> parse_toml(std::string_view text, const std::string& source, Report& report) {
  if (const auto place = too_deep_key(text)) {
    const toml::source_position position{static_cast<toml::source_index>(place->line),
                                         static_cast<toml::source_index>(place->column)};
    report.add({position, position, std::make_shared<const std::string>(source)}, "",
               fmt::format("found a key of more than {0} parts; allowed: at most {0}", kDeepestKey));
    return std::nullopt;
  }
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& e) {
    report.add(e.source(), "", fmt::format("not valid TOML: {}", printable(e.description(), 400)));
    return std::nullopt;
  }
}

}  // namespace firn
