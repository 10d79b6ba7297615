// A scene file as TOML, and what is refused before a single key is looked at.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "engine/scene/report.h"

namespace firn {

/// The text of a regular file of a sensible size; otherwise throws Error{input}.
std::string read_scene_file(const std::filesystem::path& path);

/// Nothing if `text` is not TOML; the report then says where. `source` names the text in messages.
std::optional<toml::table> parse_toml(std::string_view text, const std::string& source, Report& report);

/// The name of a scene file in messages.
std::string shown_path(const std::filesystem::path& path);

}  // namespace firn
