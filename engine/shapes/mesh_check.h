// What is wrong with a triangle mesh as the boundary of a solid. Normals are not trusted: whether a surface
// is closed is decided by edges after welding vertices at equal positions.
#pragma once

#include <string>

#include "engine/shapes/triangle_mesh.h"

namespace firn {

/// A loop or cluster of edges that belong to an odd number of triangles.
struct Hole {
  Vec3 center;
  double size;  // m: diagonal of the box around it
  std::size_t edges;
};

struct MeshReport {
  TriangleMesh mesh;        // welded, without triangles that have collapsed to a line or stand there twice
  Bounds bounds;            // of the triangles' vertices
  double area = 0;          // m^2
  double volume = 0;        // m^3, signed: negative when inside-out; holes are capped; overlaps count twice
  bool consistent = true;   // neighbouring triangles agree on which side is out
  std::vector<Hole> holes;  // largest first
};

/// Throws Error{input} when the mesh cannot bound a solid: no triangles, a vertex that is not finite, an
/// index out of range, no extent in some direction. `name` stands at the start of messages.
MeshReport inspect_mesh(const TriangleMesh& mesh, const std::string& name);

}  // namespace firn
