#include <cmath>

#include <fmt/format.h>
#include <openvdb/tools/MeshToVolume.h>

#include "engine/base/error.h"
#include "engine/shapes/level_set.h"
#include "engine/shapes/level_set_shape.h"
#include "engine/shapes/mesh_check.h"

namespace firn {
namespace {

constexpr float kBand = 3;            // voxels on each side of the surface, as is usual for level sets
constexpr double kWidest = 1 << 18;   // voxels along an axis: float distances keep 1/50 voxel up to there
constexpr double kMostSurface = 3e8;  // voxels on the surface: about 25 GB while converting
constexpr double kNothing = 0.02;   // part of the volume below which a mesh counts as thinner than the voxels
constexpr double kDoubtful = 0.05;  // relative difference of volumes worth a word

[[noreturn]] void fail(const std::string& name, const std::string& why) {
  throw Error(ExitCode::input, name + ": " + why);
}

/// The mesh in voxels about its own middle, as OpenVDB wants to see it.
struct IndexSpaceMesh {
  const TriangleMesh& mesh;
  Vec3 origin;
  double voxel;

  std::size_t polygonCount() const { return mesh.triangles.size(); }
  std::size_t pointCount() const { return mesh.vertices.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, openvdb::Vec3d& position) const {
    const Vec3 p = (mesh.vertices[mesh.triangles[polygon][corner]] - origin) / voxel;
    position = {p.x(), p.y(), p.z()};
  }
};

void check_size(const MeshReport& report, const std::string& name, double voxel) {
  const Vec3 extent = report.bounds.max - report.bounds.min;
  const double widest = extent.maxCoeff() / voxel, surface = report.area / (voxel * voxel);
  if (widest <= kWidest && surface <= kMostSurface) return;
  throw Error(
      ExitCode::resources,
      fmt::format(
          "{}: is {:.3g} x {:.3g} x {:.3g} m, {:.2g} voxels of {:.3g} m across; scale the mesh down (is it "
          "in millimetres?) or choose a larger cell_size",
          name, extent.x(), extent.y(), extent.z(), widest, voxel));
}

std::string open_surface(const MeshReport& report, double voxel, double volume) {
  const Hole& hole = report.holes.front();
  return fmt::format(
      "the surface is open: {} hole{}, the largest {:.3g} m wide at ({:.4g}, {:.4g}, {:.4g}), where a voxel "
      "is {:.3g} m; it would hold {:.3g} m^3. Close the mesh (in Blender: select non-manifold edges, "
      "then fill), or choose a cell_size larger than the hole",
      report.holes.size(), report.holes.size() == 1 ? "" : "s", hole.size, hole.center.x(), hole.center.y(),
      hole.center.z(), voxel, std::max(volume, 0.0));
}

bool agrees(double volume, double expected) {
  return std::abs(volume - expected) <= kDoubtful * expected;
}

void judge_volume(const MeshReport& report, const std::string& name, double voxel, double volume,
                  std::vector<std::string>& warnings) {
  const double expected = std::abs(report.volume);
  const bool trusted = report.consistent && agrees(volume, expected);
  if (!report.holes.empty()) {
    if (!trusted && report.holes.front().size > voxel) fail(name, open_surface(report, voxel, volume));
    warnings.push_back(
        fmt::format("{}: the surface has {} gap{} of at most {:.3g} m, which the level set closes", name,
                    report.holes.size(), report.holes.size() == 1 ? "" : "s", report.holes.front().size));
  }
  if (!(volume > 0) || (report.consistent && volume < kNothing * expected)) {
    fail(name,
         fmt::format(
             "encloses nothing as thick as a voxel of {:.3g} m (its surface encloses {:.3g} m^3); choose a "
             "smaller cell_size, or give the mesh thickness",
             voxel, expected));
  }
  if (!report.consistent) {
    warnings.push_back(
        name + ": neighbouring triangles disagree on which side is out; what the surface encloses is solid");
  } else if (report.volume < 0) {
    warnings.push_back(name + ": the mesh is inside-out; what the surface encloses is solid");
  }
  if (report.consistent && !agrees(volume, expected)) {
    warnings.push_back(
        fmt::format("{}: the solid has {:.4g} m^3 but the surface encloses {:.4g} m^3: its shells overlap "
                    "(united) or lie in one another (filled), or parts are thinner than a voxel of {:.3g} m",
                    name, volume, expected, voxel));
  }
}

}  // namespace

ShapePtr level_set_from_mesh(const TriangleMesh& mesh, const std::string& name, double voxel,
                             std::vector<std::string>& warnings) {
  const MeshReport report = inspect_mesh(mesh, name);
  check_size(report, name, voxel);

  const Vec3 origin = 0.5 * (report.bounds.min + report.bounds.max);
  const IndexSpaceMesh adapter{report.mesh, origin, voxel};
  const openvdb::math::Transform identity;
  openvdb::FloatGrid::Ptr grid =
      openvdb::tools::meshToVolume<openvdb::FloatGrid>(adapter, identity, kBand, kBand);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);

  const ShapePtr shape = make_level_set_shape(grid, {origin, Eigen::Matrix3d::Identity() * voxel});
  judge_volume(report, name, voxel, shape->bounds().empty() ? 0 : *shape->volume(), warnings);
  return shape;
}

}  // namespace firn
