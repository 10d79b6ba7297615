// From a path file to its description. The format is in fields.h.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "tools/cli/path/description.h"

namespace firn {

/// Throws Error{input} with every mistake of the file, as read_scene does. `overrides`: as after --set.
PathDescription read_path(const std::filesystem::path& file, std::span<const std::string> overrides);

/// A commented path that runs as it stands.
std::string example_path();

}  // namespace firn
