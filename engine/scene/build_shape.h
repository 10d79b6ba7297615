// From a shape as written to a Shape that can be sampled.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/problems.h"
#include "engine/scene/description.h"
#include "engine/shapes/shape.h"

namespace firn {

/// Level sets are made with voxels of `voxel` metres in the scene (half the grid's cell size is a good
/// choice). Relative files are relative to `scene_folder`; nothing in a path is expanded. What is wrong goes
/// to `problems` at the description's mark, under `key` (as in "bodies[0].shape"), and the result is null;
/// what is doubtful goes to `warnings`.
ShapePtr build_shape(const ShapeDescription& description, const std::filesystem::path& scene_folder,
                     double voxel, std::vector<std::string>& warnings, Problems& problems,
                     const std::string& key = "shape");

/// `name` as a path relative to the scene's folder unless it is absolute.
std::filesystem::path resolve_file(const std::filesystem::path& scene_folder, const std::string& name);

}  // namespace firn
