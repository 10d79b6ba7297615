#include "engine/shapes/vdb_reader.h"

#include <cstring>

#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

using openvdb::FloatGrid;
using Bytes = std::vector<std::uint8_t>;
using Leaf = FloatGrid::TreeType::LeafNodeType;
static_assert(Leaf::SIZE == sizeof(VdbLeaf::values) / sizeof(float));

[[noreturn]] void fail(const std::string& why) {
  throw Error(ExitCode::input, why);
}

bool is(const openvdb::GridBase& grid, openvdb::GridClass kind) {
  return grid.isType<FloatGrid>() && grid.getGridClass() == kind;
}

std::string find_grid(openvdb::io::File& file, const std::string& wanted, bool fog_first) {
  std::string names, level_set, fog;
  for (auto it = file.beginName(); it != file.endName(); ++it) {
    const std::string name = it.gridName();
    names += (names.empty() ? "" : ", ") + printable(name);
    const openvdb::GridBase::Ptr meta = file.readGridMetadata(name);
    const bool is_level_set = is(*meta, openvdb::GRID_LEVEL_SET),
               is_fog = is(*meta, openvdb::GRID_FOG_VOLUME);
    if (name == wanted) {
      if (is_level_set || is_fog) return name;
      fail(fmt::format(
          "grid '{}' is a {} of class '{}', not a float level set or fog volume; convert it to one",
          printable(name), printable(meta->type()),
          openvdb::GridBase::gridClassToString(meta->getGridClass())));
    }
    if (is_level_set && level_set.empty()) level_set = name;
    if (is_fog && fog.empty()) fog = name;
  }
  if (names.empty()) names = "none";
  if (!wanted.empty()) fail(fmt::format("has no grid '{}'; known: {}", printable(wanted), names));
  const std::string& first = fog_first || level_set.empty() ? fog : level_set;
  if (!first.empty()) return first;
  fail(fmt::format("holds no float {}fog volume; its grids: {}", fog_first ? "" : "level set or ", names));
}

VdbHeader header_of(const FloatGrid& grid) {
  if (!grid.transform().isLinear() || !grid.hasUniformVoxels()) {
    fail("its voxels are not cubes; resample it with a uniform voxel size");
  }
  VdbHeader header{};
  const openvdb::Vec3d zero = grid.indexToWorld(openvdb::Vec3d(0, 0, 0));
  for (int column = 0; column < 3; ++column) {
    openvdb::Vec3d unit(0, 0, 0);
    unit[column] = 1;
    const openvdb::Vec3d axis = grid.indexToWorld(unit) - zero;
    for (int row = 0; row < 3; ++row) header.axes[3 * row + column] = axis[row];
    header.origin[column] = zero[column];
  }
  header.background = grid.background();
  header.fog = is(grid, openvdb::GRID_FOG_VOLUME);
  header.leaves = grid.tree().leafCount();
  header.tiles = header.fog ? grid.tree().activeTileCount() : 0;
  const char* what = header.fog ? "fog volume" : "level set";
  if (header.leaves + header.tiles == 0) fail(fmt::format("the {} is empty", what));
  if (header.leaves > kMostVdbLeaves)
    fail(fmt::format("the {} has {} blocks, more than {}", what, header.leaves, kMostVdbLeaves));
  if (header.tiles > kMostVdbTiles)
    fail(fmt::format("the {} has {} tiles, more than {}", what, header.tiles, kMostVdbTiles));
  return header;
}

template <class Record>
void put(std::uint8_t*& at, const Record& record) {
  std::memcpy(at, &record, sizeof record);
  at += sizeof record;
}

void put_tiles(std::uint8_t*& at, const FloatGrid& grid) {
  using Iterator = openvdb::FloatTree::ValueOnCIter;
  auto tile = grid.tree().cbeginValueOn();
  tile.setMaxDepth(Iterator::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    VdbTile record{{}, tile.getLevel(), *tile};
    std::memcpy(record.origin, tile.getBoundingBox().min().asPointer(), sizeof record.origin);
    put(at, record);
  }
}

}  // namespace

Bytes read_vdb_grid(const std::string& path, const std::string& wanted, bool fog_first) {
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open(false);  // no delayed load: a file replaced while it is mapped would be a bus error
  const auto grid = openvdb::gridPtrCast<FloatGrid>(file.readGrid(find_grid(file, wanted, fog_first)));
  const VdbHeader header = header_of(*grid);
  Bytes bytes(sizeof header + header.leaves * sizeof(VdbLeaf) + header.tiles * sizeof(VdbTile));
  std::uint8_t* at = bytes.data();
  put(at, header);
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
    VdbLeaf record;
    std::memcpy(record.origin, leaf->origin().asPointer(), sizeof record.origin);
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) record.values[i] = leaf->getValue(i);
    put(at, record);
  }
  if (header.tiles > 0) put_tiles(at, *grid);
  // A grid is often larger than what is left of the memory limit: no orderly destruction, the process ends
  // here.
  return bytes;
}

}  // namespace firn
