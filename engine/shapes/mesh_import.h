// A mesh file as triangles. PLY is read here, every other format by assimp in a child process: a file that
// crashes or hangs the importer is an error message. A mesh file may not refer to other files that its
// surface depends on.
#pragma once

#include <filesystem>

#include "engine/shapes/triangle_mesh.h"

namespace firn {

inline constexpr std::size_t kMostTriangles = 20'000'000;

/// Throws Error{input} that says what is wrong with the file. Indices are valid; nothing else is checked: see
/// mesh_check.h.
TriangleMesh import_mesh(const std::filesystem::path& file);

}  // namespace firn
