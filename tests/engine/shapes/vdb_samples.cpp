#include "tests/engine/shapes/vdb_samples.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

namespace firn::test {

void write_vdb_samples(const std::filesystem::path& file, double radius, const Vec3& center, double voxel) {
  openvdb::initialize();
  const auto sphere = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
      static_cast<float>(radius), openvdb::Vec3f(0), static_cast<float>(voxel));
  const auto add = [&](const char* name, openvdb::FloatGrid::Ptr grid, openvdb::GridClass kind,
                       const openvdb::Vec3d& scale) {
    grid->setName(name);
    grid->setGridClass(kind);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    grid->transform().preScale(scale);
    grid->transform().postTranslate({center.x(), center.y(), center.z()});
    return grid;
  };
  openvdb::GridCPtrVec grids;
  grids.push_back(add("fog", openvdb::FloatGrid::create(0), openvdb::GRID_FOG_VOLUME, openvdb::Vec3d(1)));
  grids.push_back(add("sphere", sphere, openvdb::GRID_LEVEL_SET, openvdb::Vec3d(1)));
  grids.push_back(add("stretched", sphere->deepCopy(), openvdb::GRID_LEVEL_SET, openvdb::Vec3d(1, 2, 1)));
  grids.push_back(add("void", openvdb::FloatGrid::create(3), openvdb::GRID_LEVEL_SET, openvdb::Vec3d(1)));
  openvdb::io::File(file.string()).write(grids);
}

}  // namespace firn::test
