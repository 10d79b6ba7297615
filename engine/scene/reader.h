// From scene text to SceneDescription. The format is in fields.h.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "engine/scene/description.h"

namespace firn {

/// Throws Error{input} with every mistake of the scene, one a line, each with its place, what was found and
/// what is allowed. `overrides`: as in "simulation.cfl=0.2", applied in order before anything is looked at.
SceneDescription read_scene(const std::filesystem::path& path, std::span<const std::string> overrides = {});

/// The same for a text that stands for the file `path`.
SceneDescription read_scene_text(std::string_view text, const std::filesystem::path& path,
                                 std::span<const std::string> overrides = {});

}  // namespace firn
