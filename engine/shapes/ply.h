// Reader of PLY files, ASCII and binary little endian, for meshes and points. Our own because assimp's dies
// on a quarter of slightly damaged files and invents vertices for truncated ones.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/shapes/triangle_mesh.h"

namespace firn {

struct PlyFile {
  std::size_t vertex_count = 0;
  std::map<std::string, std::vector<double>> vertex;  // each scalar property of element "vertex"
  std::vector<Triangle> triangles;  // element "face", polygons as fans; indices not yet checked

  /// The property, or Error{input} naming what is missing.
  const std::vector<double>& column(const std::string& name, const std::string& file) const;
};

/// Throws Error{input} "<file>:<line>: ..." (ASCII) or "<file>: ... vertex 12 of 100" (binary). `file` names
/// the source in messages.
PlyFile read_ply(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace firn
