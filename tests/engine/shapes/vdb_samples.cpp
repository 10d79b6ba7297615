#include "tests/engine/shapes/vdb_samples.h"

#include <algorithm>
#include <cmath>

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

void write_fog_samples(const std::filesystem::path& file, double voxel) {
  openvdb::initialize();
  openvdb::GridCPtrVec grids;
  const auto add = [&](const char* name, float background, openvdb::GridClass kind) {
    const auto grid = openvdb::FloatGrid::create(background);
    grid->setName(name);
    grid->setGridClass(kind);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
    grids.push_back(grid);
    return grid;
  };
  add("heat", 0, openvdb::GRID_UNKNOWN)->tree().setValue({1, 2, 3}, 1);

  const auto ball = add("ball", 0, openvdb::GRID_FOG_VOLUME);
  const int reach = static_cast<int>(0.5 / voxel) + 4;
  const openvdb::CoordBBox around(openvdb::Coord(-reach), openvdb::Coord(reach));
  for (auto ijk = around.begin(); ijk != around.end(); ++ijk) {
    const double r = voxel * (*ijk).asVec3d().length();
    const double density = std::clamp(0.5 - std::max(r - 0.5, 0.2 - r) / (4 * voxel), 0.0, 1.0);
    if (density > 0) ball->tree().setValue(*ijk, static_cast<float>(density));
  }
  ball->pruneGrid();

  add("block", 0, openvdb::GRID_FOG_VOLUME)->fill({openvdb::Coord(0), openvdb::Coord(39, 23, 7)}, 3);
  add("endless", 0.7f, openvdb::GRID_FOG_VOLUME)->tree().setValue({1, 2, 3}, 1);
  const auto vast = add("vast", 0, openvdb::GRID_FOG_VOLUME);
  for (int i = 0; i < 6; ++i) vast->tree().addTile(3, {8192 * i, 0, 0}, 1, true);
  add("broken", 0, openvdb::GRID_FOG_VOLUME)->tree().setValue({1, 2, 3}, std::nanf(""));
  openvdb::io::File(file.string()).write(grids);
}

}  // namespace firn::test
