#include "engine/shapes/mesh_check.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <tuple>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/base/error.h"

namespace firn {
namespace {

[[noreturn]] void fail(const std::string& name, const std::string& why) {
  throw Error(ExitCode::input, name + ": " + why);
}

void check_values(const TriangleMesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) {
    fail(name, mesh.vertices.empty() ? "holds no triangles; export a polygon mesh"
                                     : "holds only points or lines; export a polygon mesh");
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3& v = mesh.vertices[i];
    if (v.allFinite()) continue;
    fail(name, fmt::format("vertex {} of {} is ({}, {}, {}), not a finite position; export the mesh again",
                           i + 1, mesh.vertices.size(), v.x(), v.y(), v.z()));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    const std::uint32_t highest = std::max({a, b, c});
    if (highest < mesh.vertices.size()) continue;
    fail(name, fmt::format("triangle {} uses vertex {} of {}", i + 1, highest, mesh.vertices.size()));
  }
}

/// For each vertex the first one at the same position.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), target(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    // Adding zero makes -0 and 0 the same.
    return std::tuple(vertices[i].x() + 0.0, vertices[i].y() + 0.0, vertices[i].z() + 0.0);
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::tuple(key(a), a) < std::tuple(key(b), b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    target[order[i]] = same ? target[order[i - 1]] : order[i];
  }
  return target;
}

std::vector<Triangle> distinct_triangles(const TriangleMesh& mesh, const std::vector<std::uint32_t>& target) {
  std::vector<std::pair<Triangle, std::size_t>> keyed;
  std::vector<Triangle> welded;
  for (const Triangle& t : mesh.triangles) {
    const Triangle w{target[t[0]], target[t[1]], target[t[2]]};
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
    Triangle key = w;
    std::sort(key.begin(), key.end());
    keyed.emplace_back(key, welded.size());
    welded.push_back(w);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < keyed.size(); ++i) {
    if (i == 0 || keyed[i].first != keyed[i - 1].first) kept.push_back(keyed[i].second);
  }
  std::sort(kept.begin(), kept.end());
  std::vector<Triangle> triangles;
  for (std::size_t i : kept) triangles.push_back(welded[i]);
  return triangles;
}

struct Edge {
  std::uint32_t low, high;
  bool forward;  // runs from low to high in its triangle
  friend auto operator<=>(const Edge&, const Edge&) = default;
};

/// Edges with an odd number of triangles; clears `consistent` where two neighbours run along their edge the
/// same way.
std::vector<Edge> open_edges(const std::vector<Triangle>& triangles, bool& consistent) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[static_cast<std::size_t>(k)], b = t[static_cast<std::size_t>((k + 1) % 3)];
      edges.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> open;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    long turns = 0;
    for (; end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high; ++end) {
      turns += edges[end].forward ? 1 : -1;
    }
    if ((end - i) % 2 == 1) open.push_back(edges[turns > 0 ? end - 1 : i]);
    if (std::abs(turns) > 1) consistent = false;
    i = end;
  }
  return open;
}

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c) {
  return a.dot(b.cross(c)) / 6;
}

/// Collects the holes and adds the volume that a fan over each would close.
void find_holes(MeshReport& report, std::vector<Edge> open, const Vec3& origin) {
  const std::vector<Vec3>& x = report.mesh.vertices;
  DisjointSets sets(x.size());
  for (const Edge& e : open) sets.join(e.low, e.high);
  std::sort(open.begin(), open.end(), [&](const Edge& a, const Edge& b) {
    return std::pair(sets.find(a.low), a) < std::pair(sets.find(b.low), b);
  });
  for (std::size_t begin = 0, end = 0; begin < open.size(); begin = end) {
    Vec3 low = x[open[begin].low], high = low, center = Vec3::Zero();
    for (; end < open.size() && sets.find(open[end].low) == sets.find(open[begin].low); ++end) {
      const Vec3 &a = x[open[end].low], &b = x[open[end].high];
      low = low.cwiseMin(a).cwiseMin(b);
      high = high.cwiseMax(a).cwiseMax(b);
      center += 0.5 * (a + b);
    }
    center /= static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 a = x[open[i].low] - origin, b = x[open[i].high] - origin, c = center - origin;
      report.volume += open[i].forward ? signed_volume(b, a, c) : signed_volume(a, b, c);
    }
    report.holes.push_back({center, (high - low).norm(), end - begin});
  }
  std::stable_sort(report.holes.begin(), report.holes.end(),
                   [](const Hole& a, const Hole& b) { return a.size > b.size; });
}

void check_extent(const MeshReport& report, const std::string& name) {
  const Vec3 extent = report.bounds.max - report.bounds.min;
  if (extent.maxCoeff() == 0) fail(name, "all vertices are at one point; scale or export it again");
  for (int axis = 0; axis < 3; ++axis) {
    if (extent[axis] > 0) continue;
    fail(name,
         fmt::format("is flat: every vertex has the same {}; a body needs a closed surface with thickness",
                     "xyz"[axis]));
  }
}

}  // namespace

MeshReport inspect_mesh(const TriangleMesh& mesh, const std::string& name) {
  check_values(mesh, name);
  MeshReport report;
  report.mesh.vertices = mesh.vertices;
  report.mesh.triangles = distinct_triangles(mesh, weld(mesh.vertices));
  if (report.mesh.triangles.empty()) fail(name, "every triangle has collapsed to a line or a point");

  const std::vector<Vec3>& x = report.mesh.vertices;
  report.bounds = {x[report.mesh.triangles[0][0]], x[report.mesh.triangles[0][0]]};
  for (const Triangle& t : report.mesh.triangles) {
    for (std::uint32_t i : t) {
      report.bounds.min = report.bounds.min.cwiseMin(x[i]);
      report.bounds.max = report.bounds.max.cwiseMax(x[i]);
    }
  }
  check_extent(report, name);

  // About the mesh's own middle: far from the origin the terms of the sum would cancel.
  const Vec3 origin = 0.5 * (report.bounds.min + report.bounds.max);
  for (const Triangle& t : report.mesh.triangles) {
    const Vec3 a = x[t[0]] - origin, b = x[t[1]] - origin, c = x[t[2]] - origin;
    report.volume += signed_volume(a, b, c);
    report.area += 0.5 * (b - a).cross(c - a).norm();
  }
  find_holes(report, open_edges(report.mesh.triangles, report.consistent), origin);
  return report;
}

}  // namespace firn
