// run.json and other small JSON files: what was run, with which settings, and what came out.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

namespace firn {

/// Writes `content`, indented, through a CheckedFile. Throws Error{ExitCode::io}.
void write_json(const std::filesystem::path& file, const nlohmann::json& content);

}  // namespace firn
