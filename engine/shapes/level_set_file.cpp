#include <cmath>
#include <cstring>
#include <memory>

#include <Eigen/LU>
#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/tools/SignedFloodFill.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/shapes/child_process.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/level_set.h"
#include "engine/shapes/level_set_shape.h"

namespace firn {
namespace {

using openvdb::FloatGrid;
using Bytes = std::vector<std::uint8_t>;
using Leaf = FloatGrid::TreeType::LeafNodeType;

constexpr std::uint64_t kLargestFile = std::uint64_t{16} << 30;
constexpr std::uint64_t kMostLeaves = 8'000'000;  // 16 GB of values

[[noreturn]] void fail(const std::string& why) {
  throw Error(ExitCode::input, why);
}

/// What the child hands over: numbers only, so that nothing of the file's structure reaches this process.
struct Header {
  double axes[9], origin[3];  // world position of index i: origin + axes * i
  double background;          // m
  std::uint64_t leaves;
};

struct LeafRecord {
  std::int32_t origin[3];
  float values[Leaf::SIZE];
};

openvdb::GridBase::Ptr find_grid(openvdb::io::File& file, const std::string& wanted) {
  std::string names;
  for (auto it = file.beginName(); it != file.endName(); ++it) {
    const std::string name = it.gridName();
    names += (names.empty() ? "" : ", ") + printable(name);
    const openvdb::GridBase::Ptr meta = file.readGridMetadata(name);
    const bool level_set = meta->isType<FloatGrid>() && meta->getGridClass() == openvdb::GRID_LEVEL_SET;
    if (wanted.empty() ? level_set : name == wanted) {
      if (level_set) return file.readGrid(name);
      fail(fmt::format("grid '{}' is a {} of class '{}', not a float level set; convert it to one",
                       printable(name), printable(meta->type()),
                       openvdb::GridBase::gridClassToString(meta->getGridClass())));
    }
  }
  if (wanted.empty())
    fail(fmt::format("holds no float level set; its grids: {}", names.empty() ? "none" : names));
  fail(fmt::format("has no grid '{}'; known: {}", printable(wanted), names.empty() ? "none" : names));
}

Header header_of(const FloatGrid& grid) {
  if (!grid.transform().isLinear() || !grid.hasUniformVoxels()) {
    fail("its voxels are not cubes; resample the level set with a uniform voxel size");
  }
  Header header{};
  const openvdb::Vec3d zero = grid.indexToWorld(openvdb::Vec3d(0, 0, 0));
  for (int column = 0; column < 3; ++column) {
    openvdb::Vec3d unit(0, 0, 0);
    unit[column] = 1;
    const openvdb::Vec3d axis = grid.indexToWorld(unit) - zero;
    for (int row = 0; row < 3; ++row) header.axes[3 * row + column] = axis[row];
    header.origin[column] = zero[column];
  }
  header.background = grid.background();
  header.leaves = grid.tree().leafCount();
  if (header.leaves == 0) fail("the level set is empty");
  if (header.leaves > kMostLeaves)
    fail(fmt::format("the level set has {} blocks, more than {}", header.leaves, kMostLeaves));
  return header;
}

Bytes read_in_child(const std::string& path, const std::string& wanted) {
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open(false);  // no delayed load: a file replaced while it is mapped would be a bus error
  const FloatGrid::Ptr grid = openvdb::gridPtrCast<FloatGrid>(find_grid(file, wanted));
  const Header header = header_of(*grid);
  Bytes bytes(sizeof header + header.leaves * sizeof(LeafRecord));
  std::memcpy(bytes.data(), &header, sizeof header);
  std::uint8_t* at = bytes.data() + sizeof header;
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf, at += sizeof(LeafRecord)) {
    LeafRecord record;
    std::memcpy(record.origin, leaf->origin().asPointer(), sizeof record.origin);
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) record.values[i] = leaf->getValue(i);
    std::memcpy(at, &record, sizeof record);
  }
  // A level set is often larger than what is left of the memory limit: no orderly destruction, the process
  // ends here.
  return bytes;
}

class Rebuilder {
 public:
  Rebuilder(const Bytes& bytes, const std::string& subject) : bytes_(bytes), subject_(subject) {
    if (bytes.size() < sizeof header_) refuse("torn answer from the reader");
    std::memcpy(&header_, bytes.data(), sizeof header_);
    if (bytes.size() != sizeof header_ + header_.leaves * sizeof(LeafRecord))
      refuse("torn answer from the reader");
    frame_.axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(header_.axes);
    frame_.origin = Eigen::Map<const Vec3>(header_.origin);
    voxel_ = frame_.axes.col(0).norm();
    const bool finite = frame_.axes.allFinite() && frame_.origin.allFinite();
    if (!finite || !(voxel_ > 0) || !(std::abs(frame_.axes.determinant()) > 0))
      refuse("its transform is not valid");
    if (!(header_.background > 0) || !std::isfinite(header_.background))
      refuse("its background is not a distance > 0");
  }

  ShapePtr build() {
    const openvdb::Coord shift = middle();
    const float band = static_cast<float>(header_.background / voxel_);
    auto grid = FloatGrid::create(band);
    bool inside = false;
    for (std::uint64_t i = 0; i < header_.leaves; ++i) {
      const LeafRecord record = leaf(i);
      const openvdb::Coord origin = openvdb::Coord(record.origin) - shift;
      auto node = std::make_unique<Leaf>(origin, band, false);
      for (openvdb::Index k = 0; k < Leaf::SIZE; ++k) {
        const float value = static_cast<float>(record.values[k] / voxel_);
        if (!std::isfinite(value)) refuse("holds a distance that is not finite");
        inside = inside || value < 0;
        if (std::abs(value) < band)
          node->setValueOn(k, value);
        else
          node->setValueOff(k, std::copysign(band, value));
      }
      grid->tree().addLeaf(node.release());
    }
    if (!inside) refuse("the level set is negative nowhere: it encloses nothing");
    openvdb::tools::signedFloodFill(grid->tree());
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    frame_.origin += frame_.axes * Vec3(shift.x(), shift.y(), shift.z());
    return make_level_set_shape(grid, frame_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { fail(subject_ + ": " + why); }

  LeafRecord leaf(std::uint64_t i) const {
    LeafRecord record;
    std::memcpy(&record, bytes_.data() + sizeof header_ + i * sizeof record, sizeof record);
    for (std::int32_t c : record.origin) {
      if (c % 8 != 0 || std::abs(static_cast<double>(c)) > 1e9)
        refuse("holds a block at an impossible place");
    }
    return record;
  }

  /// The block in the middle: distances are measured and volumes summed about it.
  openvdb::Coord middle() const {
    openvdb::CoordBBox box;
    for (std::uint64_t i = 0; i < header_.leaves; ++i) box.expand(openvdb::Coord(leaf(i).origin));
    const openvdb::Vec3d center = box.getCenter();
    const auto rounded = [](double c) { return 8 * static_cast<std::int32_t>(std::floor(c / 8)); };
    return {rounded(center.x()), rounded(center.y()), rounded(center.z())};
  }

  const Bytes& bytes_;
  const std::string& subject_;
  Header header_{};
  IndexFrame frame_;
  double voxel_ = 0;
};

}  // namespace

ShapePtr read_level_set(const std::filesystem::path& file, const std::string& grid) {
  const std::string subject = quoted(file);
  const std::uint64_t size = check_regular_file(file, kLargestFile);
  // Compressed files unpack to some ten times their size, and the answer is a copy.
  const ChildLimits limits{(std::uint64_t{512} << 20) + 32 * size, static_cast<unsigned>(4 + (size >> 22)),
                           sizeof(Header) + kMostLeaves * sizeof(LeafRecord), true};
  const std::string path = file.string();
  const Bytes bytes = run_in_child(subject, limits, [&] { return read_in_child(path, grid); });
  return Rebuilder(bytes, subject).build();
}

}  // namespace firn
