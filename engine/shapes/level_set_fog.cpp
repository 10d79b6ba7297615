#include <cmath>
#include <vector>

#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>

#include "engine/shapes/level_set_shape.h"

namespace firn {

double tile_surface(const openvdb::FloatGrid& fog, float threshold) {
  const auto density = fog.getConstAccessor();
  double surface = 0;
  auto tile = fog.tree().cbeginValueOn();
  tile.setMaxDepth(openvdb::FloatTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    const openvdb::CoordBBox box = tile.getBoundingBox();
    const int edge = box.dim().x();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, edge}) {
        openvdb::Coord beside = box.min() + openvdb::Coord(edge / 2);
        beside[axis] = box.min()[axis] + step;
        if ((density.getValue(beside) >= threshold) != (*tile >= threshold))
          surface += static_cast<double>(edge) * edge;
      }
    }
  }
  return surface;
}

// OpenVDB's levelSetRebuild would fill closed pores: it takes all that the surface cuts off from the outside
// for solid. So distances come from the surface, as there, and signs from the densities.
openvdb::FloatGrid::Ptr level_set_of_fog(const openvdb::FloatGrid& fog, float threshold) {
  constexpr float band = 3;  // voxels, as is usual for level sets
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(fog, points, quads, threshold);
  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec4I> surface(points, quads);
  const openvdb::math::Transform identity;
  const openvdb::FloatGrid::Ptr grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      surface, identity, band, band, openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  const auto density = fog.getConstAccessor();
  for (auto voxel = grid->beginValueOn(); voxel; ++voxel) {
    if (density.getValue(voxel.getCoord()) >= threshold) voxel.setValue(-*voxel);
  }
  openvdb::tools::signedFloodFill(grid->tree());
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

}  // namespace firn
