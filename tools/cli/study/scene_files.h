// The files that a scene is read from beside its own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/description.h"

namespace firn {

/// As the scene names them, in the order of its keys.
std::vector<std::string> scene_files(SceneDescription scene);

/// A text that changes when one of them does: each with the time it was last written at, a stack of pictures
/// with those of its folder.
std::string scene_files_stamp(const SceneDescription& scene);

}  // namespace firn
