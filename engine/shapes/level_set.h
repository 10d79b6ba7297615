// Solids as level sets: from a triangle mesh and from a .vdb file. Plain header; only
// level_set*.cpp and vdb_reader.cpp see OpenVDB.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/shapes/shape.h"
#include "engine/shapes/triangle_mesh.h"

namespace firn {

/// The solid a mesh encloses, as a narrow band of `voxel` metres a voxel. Normals do not matter; overlapping
/// shells are united; a shell inside another is filled (subtract a mesh to make a cavity); gaps narrower than
/// a voxel are closed. Works about the mesh's own middle in double precision, so neither a far offset nor a
/// tiny voxel costs accuracy. Throws Error{input} or Error{resources} with what is wrong and how to mend it;
/// adds what is doubtful to `warnings`. `name` stands at the start of messages.
ShapePtr level_set_from_mesh(const TriangleMesh& mesh, const std::string& name, double voxel,
                             std::vector<std::string>& warnings);

/// Grid `grid` of a .vdb file: a level set, or a fog volume, which is solid where its density is at least
/// `threshold` (0.5 if left out; no threshold for a level set). When `grid` is empty the first level set, or
/// with a threshold or without any level set the first fog volume. The file is read in a child process, since
/// damaged files can crash the reader. Throws Error{input}.
ShapePtr read_level_set(const std::filesystem::path& file, const std::string& grid,
                        std::optional<double> threshold = std::nullopt);

}  // namespace firn
