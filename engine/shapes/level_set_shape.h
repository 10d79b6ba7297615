// A Shape that samples an OpenVDB grid. Includes OpenVDB: only for level_set*.cpp.
#pragma once

#include <openvdb/openvdb.h>

#include "engine/shapes/shape.h"

namespace firn {

/// Where index space lies in the world: x = origin + axes * index. The columns of `axes` are orthogonal and
/// of equal length.
struct IndexFrame {
  Vec3 origin;
  Eigen::Matrix3d axes;
};

/// `grid` holds signed distances in voxels under an identity transform, active in its narrow band, signed
/// everywhere.
ShapePtr make_level_set_shape(openvdb::FloatGrid::ConstPtr grid, const IndexFrame& frame);

/// How many voxels of surface lie on the faces of tiles: what a small file can hold any number of.
double tile_surface(const openvdb::FloatGrid& fog, float threshold);

/// `fog` as make_level_set_shape wants it: solid, also in and around closed pores, where the density is at
/// least `threshold`. The transform of `fog` is the identity, and its background is less dense.
openvdb::FloatGrid::Ptr level_set_of_fog(const openvdb::FloatGrid& fog, float threshold);

}  // namespace firn
