#include <cmath>
#include <cstring>
#include <memory>

#include <Eigen/LU>
#include <fmt/format.h>
#include <openvdb/tools/SignedFloodFill.h>

#include "engine/base/error.h"
#include "engine/shapes/child_process.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/level_set.h"
#include "engine/shapes/level_set_shape.h"
#include "engine/shapes/vdb_reader.h"

namespace firn {
namespace {

using openvdb::FloatGrid;
using Bytes = std::vector<std::uint8_t>;
using Leaf = FloatGrid::TreeType::LeafNodeType;

constexpr std::uint64_t kLargestFile = std::uint64_t{16} << 30;
constexpr double kDensity = 0.5;  // where the surface of a fog volume is, unless the scene says

constexpr double kMostSurface = 3e8;  // voxels: about 25 GB while a fog volume is converted

/// Edge in voxels of a tile on each level, level 0 being a leaf.
constexpr std::int32_t kEdges[] = {8, 8, 128, 4096};

class Rebuilder {
 public:
  Rebuilder(const Bytes& bytes, const std::string& subject) : bytes_(bytes), subject_(subject) {
    if (bytes.size() < sizeof header_) refuse("torn answer from the reader");
    std::memcpy(&header_, bytes.data(), sizeof header_);
    if (bytes.size() != sizeof header_ + header_.leaves * sizeof(VdbLeaf) + header_.tiles * sizeof(VdbTile))
      refuse("torn answer from the reader");
    frame_.axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(header_.axes);
    frame_.origin = Eigen::Map<const Vec3>(header_.origin);
    voxel_ = frame_.axes.col(0).norm();
    const bool finite = frame_.axes.allFinite() && frame_.origin.allFinite();
    if (!finite || !(voxel_ > 0) || !(std::abs(frame_.axes.determinant()) > 0))
      refuse("its transform is not valid");
    shift_ = middle();
    frame_.origin += frame_.axes * Vec3(shift_.x(), shift_.y(), shift_.z());
  }

  ShapePtr build(std::optional<double> threshold) const {
    if (header_.fog) return build_fog(threshold.value_or(kDensity));
    if (threshold) refuse("is a level set; allowed: a threshold for a fog volume only");
    return build_level_set();
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ExitCode::input, subject_ + ": " + why);
  }

  ShapePtr build_level_set() const {
    if (!(header_.background > 0) || !std::isfinite(header_.background))
      refuse("its background is not a distance > 0");
    const float band = static_cast<float>(header_.background / voxel_);
    auto grid = FloatGrid::create(band);
    bool inside = false;
    for (std::uint64_t i = 0; i < header_.leaves; ++i) {
      const VdbLeaf record = leaf(i);
      auto node = std::make_unique<Leaf>(openvdb::Coord(record.origin) - shift_, band, false);
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
    return make_level_set_shape(grid, frame_);
  }

  ShapePtr build_fog(double threshold) const {
    if (!(header_.background < threshold))
      refuse(fmt::format("the fog volume's background of {} is not below the threshold, {}; it has no end",
                         header_.background, threshold));
    auto fog = FloatGrid::create(static_cast<float>(header_.background));
    float densest = fog->background();
    const auto density = [&](float value) {
      if (!std::isfinite(value)) refuse("holds a density that is not finite");
      densest = std::max(densest, value);
      return value;
    };
    for (std::uint64_t i = 0; i < header_.tiles; ++i) {
      const VdbTile record = tile(i);
      fog->tree().addTile(record.level, openvdb::Coord(record.origin) - shift_, density(record.value), true);
    }
    for (std::uint64_t i = 0; i < header_.leaves; ++i) {
      const VdbLeaf record = leaf(i);
      auto node = std::make_unique<Leaf>(openvdb::Coord(record.origin) - shift_, fog->background(), true);
      for (openvdb::Index k = 0; k < Leaf::SIZE; ++k) node->setValueOn(k, density(record.values[k]));
      fog->tree().addLeaf(node.release());
    }
    if (densest < threshold)
      refuse(fmt::format("the fog volume's densest voxel has {}; allowed: a threshold up to there, not {}",
                         densest, threshold));
    const auto isovalue = static_cast<float>(threshold);
    if (const double surface = tile_surface(*fog, isovalue); surface > kMostSurface)
      refuse(fmt::format("its tiles alone have a surface of {} voxels; allowed: {}", surface, kMostSurface));
    return make_level_set_shape(level_set_of_fog(*fog, isovalue), frame_);
  }

  template <class Record>
  Record record(std::size_t at) const {
    Record result;
    std::memcpy(&result, bytes_.data() + at, sizeof result);
    return result;
  }

  void check_place(const std::int32_t (&origin)[3], std::uint32_t level) const {
    for (std::int32_t c : origin) {
      if (c % kEdges[level] != 0 || std::abs(static_cast<double>(c)) > 1e9)
        refuse("holds a block at an impossible place");
    }
  }

  VdbLeaf leaf(std::uint64_t i) const {
    const auto result = record<VdbLeaf>(sizeof header_ + i * sizeof(VdbLeaf));
    check_place(result.origin, 0);
    return result;
  }

  VdbTile tile(std::uint64_t i) const {
    const auto result =
        record<VdbTile>(sizeof header_ + header_.leaves * sizeof(VdbLeaf) + i * sizeof(VdbTile));
    if (result.level < 1 || result.level > 3) refuse("holds a tile of an impossible size");
    check_place(result.origin, result.level);
    return result;
  }

  /// The block in the middle: distances are measured and volumes summed about it. Tiles stay where they may
  /// be.
  openvdb::Coord middle() const {
    openvdb::CoordBBox box;
    for (std::uint64_t i = 0; i < header_.leaves; ++i) box.expand(openvdb::Coord(leaf(i).origin));
    for (std::uint64_t i = 0; i < header_.tiles; ++i) box.expand(openvdb::Coord(tile(i).origin));
    const openvdb::Vec3d center = box.getCenter();
    const std::int32_t step = header_.tiles > 0 ? kEdges[3] : kEdges[0];
    const auto rounded = [&](double c) { return step * static_cast<std::int32_t>(std::floor(c / step)); };
    return {rounded(center.x()), rounded(center.y()), rounded(center.z())};
  }

  const Bytes& bytes_;
  const std::string& subject_;
  VdbHeader header_{};
  IndexFrame frame_;
  double voxel_ = 0;
  openvdb::Coord shift_;
};

}  // namespace

ShapePtr read_level_set(const std::filesystem::path& file, const std::string& grid,
                        std::optional<double> threshold) {
  const std::string subject = quoted(file);
  const std::uint64_t size = check_regular_file(file, kLargestFile);
  // Compressed files unpack to some ten times their size, and the answer is a copy.
  const ChildLimits limits{
      (std::uint64_t{512} << 20) + 32 * size, static_cast<unsigned>(4 + (size >> 22)),
      sizeof(VdbHeader) + kMostVdbLeaves * sizeof(VdbLeaf) + kMostVdbTiles * sizeof(VdbTile), true};
  const std::string path = file.string();
  const Bytes bytes =
      run_in_child(subject, limits, [&] { return read_vdb_grid(path, grid, threshold.has_value()); });
  return Rebuilder(bytes, subject).build(threshold);
}

}  // namespace firn
