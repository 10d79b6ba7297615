// With point_cache_reader.cpp the only file of the output layer that includes OpenVDB: half a minute to
// compile.
#include "engine/output/point_cache.h"

#include <cmath>
#include <mutex>
#include <vector>

#include <fmt/format.h>
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>

#include "engine/base/check.h"
#include "engine/output/checked_file.h"
#include "engine/output/gather.h"
#include "engine/output/spread_check.h"

namespace firn {
namespace {

using openvdb::points::PointDataGrid;
using openvdb::tools::PointIndexGrid;

// io::File::write() reports neither a full disk nor any other failed write, so the archive is written to a
// stream of ours; Archive keeps that for derived classes.
class StreamArchive : public openvdb::io::Archive {
 public:
  void write_to(std::ostream& out, const openvdb::GridCPtrVec& grids,
                const openvdb::MetaMap& metadata) const {
    constexpr bool kSeekable = true;  // grid offsets in the header, as in any file
    Archive::write(out, grids, kSeekable, metadata);
  }
};

// A gathered column as the array type that OpenVDB's conversion functions take.
template <class Value>
class Values {
 public:
  using value_type = Value;
  using PosType = Value;
  using Component = typename openvdb::ValueTraits<Value>::ElementType;

  Values(std::size_t size, std::vector<Component> components)
      : size_(size), components_(std::move(components)) {}
  std::size_t size() const { return size_; }
  void getPos(std::size_t i, Value& value) const { get(value, i, 0); }
  void get(Value& value, std::size_t i, openvdb::Index) const {
    if constexpr (std::is_same_v<Value, Component>) {
      value = components_[i];
    } else {
      value = Value(&components_[i * openvdb::ValueTraits<Value>::Elements]);
    }
  }
  const std::vector<Component>& components() const { return components_; }

 private:
  std::size_t size_;
  std::vector<Component> components_;
};

template <class Value>
void add(PointDataGrid& grid, const PointIndexGrid& order, const std::string& name,
         const Values<Value>& values) {
  openvdb::points::appendAttribute<Value>(grid.tree(), name);
  openvdb::points::populateAttribute(grid.tree(), order.tree(), name, values);
}

void add(PointDataGrid& grid, const PointIndexGrid& order, const FrameView& frame,
         const AttributeView& attribute) {
  const auto components = static_cast<std::size_t>(attribute.components);
  auto values = gather<float>(frame.particles, components, attribute.copy);
  if (attribute.name == "material") {
    std::vector<std::int32_t> whole(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      whole[i] = static_cast<std::int32_t>(std::lround(values[i]));
    return add(grid, order, attribute.name, Values<std::int32_t>(frame.particles, std::move(whole)));
  }
  switch (attribute.components) {
    case 1:
      return add(grid, order, attribute.name, Values<float>(frame.particles, std::move(values)));
    case 3:
      return add(grid, order, attribute.name, Values<openvdb::Vec3f>(frame.particles, std::move(values)));
    case 9:
      return add(grid, order, attribute.name, Values<openvdb::Mat3s>(frame.particles, std::move(values)));
    default:
      FIRN_CHECK(!"an attribute has 1, 3 or 9 components");
  }
}

PointDataGrid::Ptr make_grid(const FrameView& frame, double voxel_size) {
  FIRN_CHECK(!frame.attributes.empty() && frame.attributes[0].name == "P" &&
             frame.attributes[0].components == 3);
  const Values<openvdb::Vec3f> positions(frame.particles,
                                         gather<float>(frame.particles, 3, frame.attributes[0].copy));
  check_spread(frame, positions.components(), voxel_size);

  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_size);
  const auto order = openvdb::tools::createPointIndexGrid<PointIndexGrid>(positions, *transform);
  auto grid = openvdb::points::createPointDataGrid<openvdb::points::NullCodec, PointDataGrid>(
      *order, positions, *transform);
  add(*grid, *order, "id",
      Values<std::int64_t>(frame.particles, gather<std::int64_t>(frame.particles, 1, frame.copy_id)));
  for (std::size_t i = 1; i < frame.attributes.size(); ++i) add(*grid, *order, frame, frame.attributes[i]);
  return grid;
}

std::uint64_t uncompressed_bytes(const FrameView& frame) {
  std::uint64_t each = sizeof(std::int64_t);
  for (const AttributeView& a : frame.attributes)
    each += static_cast<std::uint64_t>(a.components) * sizeof(float);
  return each * frame.particles;
}

}  // namespace

std::string point_cache_name(int frame) {
  return fmt::format("particles.{:04}.vdb", frame);
}

std::uint64_t write_point_cache(const std::filesystem::path& file, const FrameView& frame,
                                const PointCacheSettings& settings) {
  FIRN_CHECK(settings.voxel_size > 0);
  static std::once_flag initialized;
  std::call_once(initialized, [] { openvdb::initialize(); });

  const auto grid = make_grid(frame, settings.voxel_size);
  grid->setName("points");
  grid->setCreator(settings.creator);

  openvdb::MetaMap metadata;
  metadata.insertMeta("creator", openvdb::StringMetadata(settings.creator));
  metadata.insertMeta("frame", openvdb::Int32Metadata(frame.frame));
  metadata.insertMeta("time", openvdb::DoubleMetadata(frame.time));
  metadata.insertMeta("frame_rate", openvdb::DoubleMetadata(settings.frame_rate));

  StreamArchive archive;
  archive.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
  CheckedFile out(file, uncompressed_bytes(frame));
  archive.write_to(out.stream(), {grid}, metadata);
  return out.commit();
}

}  // namespace firn
