// How far the nodes of a lattice are from the surface where a field given on them changes its sign.
//
// A node that has a neighbour of the other sign makes a patch of surface: a disc, half an edge in radius,
// about the foot of its perpendicular on the plane through the surface's crossings with the edges about it.
// Every node takes the nearest patch that it hears of from its neighbours. That is the distance map of P.-E.
// Danielsson, "Euclidean distance mapping", 1980 (there nodes hear of nodes, and a distance is off by up to
// half an edge), with edges of any lengths. What is left is a tenth of an edge or so, where the surface bends
// within one.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/shapes/shape.h"

namespace firn {

/// Nodes along x, y, z and the edges between them; along an axis with one node nothing changes.
struct Lattice {
  std::array<std::size_t, 3> count;
  Vec3 edge;
};

/// The distance of each node, not negative; infinite where `field` has one sign everywhere. `field`: x
/// fastest, at most 2^32 - 1 nodes, none of them 0.
std::vector<float> distances_to_surface(const Lattice& lattice, std::span<const float> field);

}  // namespace firn
