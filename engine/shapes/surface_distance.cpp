#include "engine/shapes/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace firn {
namespace {

using Point = Eigen::Vector3f;

constexpr float kRadius = 0.5f;  // of a patch, in the shortest edge
constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class NearestPatches {
 public:
  NearestPatches(const Lattice& lattice, std::span<const float> field)
      : n_(lattice.count),
        stride_{1, n_[0], n_[0] * n_[1]},
        unit_(shortest_edge(lattice)),
        edge_((lattice.edge / unit_).cast<float>()),
        field_(field),
        nearest_(field.size(), kNone),
        square_(field.size(), kFar) {
    start();
    sweep_planes();
  }

  std::vector<float> distances() && {
    // A patch may reach through a node of its neighbours, where the field is not 0 and the distance neither.
    for (const Patch& patch : patches_) square_[patch.node] = std::max(square_[patch.node], patch.square / 9);
    for (float& d : square_) d = static_cast<float>(unit_ * std::sqrt(d));
    return std::move(square_);
  }

 private:
  using Node = std::array<std::size_t, 3>;

  struct Patch {
    Point middle, normal;
    float square;        // of its distance from the node that made it
    std::uint32_t node;  // that one
  };

  static double shortest_edge(const Lattice& lattice) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (lattice.count[axis] > 1)
        shortest = std::min(shortest, lattice.edge[static_cast<Eigen::Index>(axis)]);
    }
    return std::isfinite(shortest) ? shortest : 1;
  }

  std::size_t index(const Node& node) const { return node[0] + stride_[1] * node[1] + stride_[2] * node[2]; }

  Point place(const Node& node) const {
    Point x = Point::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      if (n_[axis] > 1) x[a] = edge_[a] * static_cast<float>(node[axis]);
    }
    return x;
  }

  /// From the node to the nearer crossing on its two edges along an axis, 0 if there is none.
  float crossing(const Node& node, std::size_t axis) const {
    const std::size_t here = index(node);
    const float edge = edge_[static_cast<Eigen::Index>(axis)], f = std::abs(field_[here]);
    float nearest = 0;
    const auto look = [&](bool exists, std::size_t there, float direction) {
      if (!exists || (field_[there] < 0) == (field_[here] < 0)) return;
      const float s = edge * f / (f + std::abs(field_[there]));
      if (nearest == 0 || s < std::abs(nearest)) nearest = direction * s;
    };
    look(node[axis] > 0, here - stride_[axis], -1);
    look(node[axis] + 1 < n_[axis], here + stride_[axis], 1);
    return nearest;
  }

  void start() {
    Node node;
    for (node[2] = 0; node[2] < n_[2]; ++node[2])
      for (node[1] = 0; node[1] < n_[1]; ++node[1])
        for (node[0] = 0; node[0] < n_[0]; ++node[0]) start_at(node);
  }

  void start_at(const Node& node) {
    // The plane through the crossings s is sum x / s = 1; its nearest point is (1 / s) / |1 / s|^2.
    Point inverse = Point::Zero();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (const float s = crossing(node, axis); s != 0) inverse[static_cast<Eigen::Index>(axis)] = 1 / s;
    }
    if (inverse.isZero(0)) return;
    const std::size_t i = index(node);
    square_[i] = 1 / inverse.squaredNorm();
    nearest_[i] = static_cast<std::uint32_t>(patches_.size());
    patches_.push_back({place(node) + inverse * square_[i], inverse.normalized(), square_[i],
                        static_cast<std::uint32_t>(i)});
  }

  void hear(std::size_t node, const Point& at, std::size_t from) {
    if (nearest_[from] == kNone) return;
    const Patch& patch = patches_[nearest_[from]];
    const Point way = at - patch.middle;
    const float above = way.dot(patch.normal);
    if (above * above >= square_[node]) return;
    const float beside =
        std::max(std::sqrt(std::max(way.squaredNorm() - above * above, 0.0f)) - kRadius, 0.0f);
    const float square = above * above + beside * beside;
    if (square >= square_[node]) return;
    square_[node] = square;
    nearest_[node] = nearest_[from];
  }

  /// From the row beside along `axis`, on the side of `node`'s lower or higher neighbours.
  void hear_row(Node node, std::size_t axis, bool lower) {
    for (node[0] = 0; node[0] < n_[0]; ++node[0]) {
      const std::size_t i = index(node);
      hear(i, place(node), lower ? i - stride_[axis] : i + stride_[axis]);
    }
  }

  void sweep_row(Node node) {
    for (node[0] = 1; node[0] < n_[0]; ++node[0]) hear(index(node), place(node), index(node) - 1);
    for (node[0] = n_[0] - 1; node[0]-- > 0;) hear(index(node), place(node), index(node) + 1);
  }

  void sweep_rows(Node node) {
    for (node[1] = 0; node[1] < n_[1]; ++node[1]) {
      if (node[1] > 0) hear_row(node, 1, true);
      sweep_row(node);
    }
    for (node[1] = n_[1] - 1; node[1]-- > 0;) {
      hear_row(node, 1, false);
      sweep_row(node);
    }
  }

  void hear_plane(Node node, bool lower) {
    for (node[1] = 0; node[1] < n_[1]; ++node[1]) hear_row(node, 2, lower);
  }

  void sweep_planes() {
    Node node{};
    for (node[2] = 0; node[2] < n_[2]; ++node[2]) {
      if (node[2] > 0) hear_plane(node, true);
      sweep_rows(node);
    }
    for (node[2] = n_[2] - 1; node[2]-- > 0;) {
      hear_plane(node, false);
      sweep_rows(node);
    }
  }

  Node n_, stride_;
  double unit_;  // lengths below are in the shortest edge: squares of metres could leave float's range
  Point edge_;
  std::span<const float> field_;
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> nearest_;  // patch of each node
  std::vector<float> square_;           // of the distance to it
};

}  // namespace

std::vector<float> distances_to_surface(const Lattice& lattice, std::span<const float> field) {
  return NearestPatches(lattice, field).distances();
}

}  // namespace firn
