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

}  // namespace firn
