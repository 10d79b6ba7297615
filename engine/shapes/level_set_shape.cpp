#include "engine/shapes/level_set_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/LU>
#include <openvdb/tools/Interpolation.h>
#include <tbb/parallel_for.h>

namespace firn {
namespace {

openvdb::Vec3d to_vdb(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// The part of the cell between eight voxels where the interpolated distance is negative. Exact where all
/// corners agree, so a sheet thinner than a voxel has no volume, as it gets no particles. (OpenVDB's own
/// levelSetVolume integrates over a band of three voxels, and gives such a sheet the volume of half a voxel's
/// thickness.)
double solid_part(const std::array<float, 8>& corner) {
  const auto [least, most] = std::minmax_element(corner.begin(), corner.end());
  if (*least >= 0) return 0;
  if (*most <= 0) return 1;
  constexpr int n = 4;
  const auto mix = [](float a, float b, int i) { return a + (b - a) * (static_cast<float>(i) + 0.5f) / n; };
  double solid = 0;
  for (int i = 0; i < n; ++i) {
    std::array<float, 4> face;
    for (std::size_t k = 0; k < 4; ++k) face[k] = mix(corner[k], corner[k + 4], i);
    for (int j = 0; j < n; ++j) {
      const float a = mix(face[0], face[2], j), b = mix(face[1], face[3], j);
      for (int k = 0; k < n; ++k) solid += std::clamp(0.5f - n * mix(a, b, k), 0.0f, 1.0f);
    }
  }
  return solid / (n * n * n);
}

/// The volume of what is negative, in voxels; the same bits for any number of threads.
double solid_cells(const openvdb::FloatGrid& grid) {
  using Leaf = openvdb::FloatGrid::TreeType::LeafNodeType;
  std::vector<const Leaf*> leaves;
  grid.tree().getNodes(leaves);
  std::vector<double> part(leaves.size(), 0.0);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t l) {
    auto accessor = grid.getConstUnsafeAccessor();
    for (openvdb::Index i = 0; i < Leaf::SIZE; ++i) {
      const openvdb::Coord low = leaves[l]->offsetToGlobalCoord(i);
      std::array<float, 8> corner;
      for (int c = 0; c < 8; ++c) {
        corner[static_cast<std::size_t>(c)] = accessor.getValue(low.offsetBy(c >> 2, (c >> 1) & 1, c & 1));
      }
      part[l] += solid_part(corner);
    }
  });
  double sum = std::accumulate(part.begin(), part.end(), 0.0);
  // Tiles: deep inside, nothing but negative.
  auto tile = grid.tree().cbeginValueAll();
  for (tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1); tile; ++tile) {
    if (*tile < 0) sum += static_cast<double>(tile.getVoxelCount());
  }
  return sum;
}

class LevelSetShape final : public Shape {
 public:
  LevelSetShape(openvdb::FloatGrid::ConstPtr grid, const IndexFrame& frame)
      : grid_(std::move(grid)),
        frame_(frame),
        to_index_(frame.axes.inverse()),
        voxel_(frame.axes.col(0).norm()),
        band_(grid_->background()) {
    const openvdb::CoordBBox box = grid_->evalActiveVoxelBoundingBox();
    low_ = Vec3(box.min().x(), box.min().y(), box.min().z());
    high_ = Vec3(box.max().x(), box.max().y(), box.max().z());
    solid_ = bounds_of_solid();
    volume_ = solid_cells(*grid_) * voxel_ * voxel_ * voxel_;
  }

  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    // Unregistered: registering with the tree would serialise the threads.
    auto accessor = grid_->getConstUnsafeAccessor();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 index = to_index_ * (points[i] - frame_.origin);
      phi[i] = voxel_ * (near(index) ? sample(accessor, index) : band_);
    }
  }

  Bounds bounds() const override { return solid_; }
  std::optional<double> volume() const override { return volume_; }

 private:
  using Accessor = openvdb::FloatGrid::ConstUnsafeAccessor;

  /// Within the band's box; also what keeps far and non-finite points from wrapping round as integers.
  bool near(const Vec3& index) const {
    return (index.array() >= low_.array()).all() && (index.array() <= high_.array()).all();
  }

  static double sample(Accessor& accessor, const Vec3& index) {
    float value = 0;
    openvdb::tools::BoxSampler::sample(accessor, to_vdb(index), value);
    return value;
  }

  Bounds bounds_of_solid() const {
    // A voxel with a negative value makes its neighbours' cells partly solid: one voxel more on each side.
    openvdb::CoordBBox box;
    for (auto it = grid_->cbeginValueOn(); it; ++it) {
      if (*it <= 0) box.expand(it.getBoundingBox());
    }
    if (box.empty()) return {};
    const Vec3 low(box.min().x() - 1, box.min().y() - 1, box.min().z() - 1);
    const Vec3 high(box.max().x() + 1, box.max().y() + 1, box.max().z() + 1);
    const Vec3 center = frame_.origin + frame_.axes * (0.5 * (low + high));
    const Vec3 half = frame_.axes.cwiseAbs() * (0.5 * (high - low));
    return {center - half, center + half};
  }

  openvdb::FloatGrid::ConstPtr grid_;
  IndexFrame frame_;
  Eigen::Matrix3d to_index_;
  double voxel_, band_, volume_;
  Vec3 low_, high_;
  Bounds solid_;
};

}  // namespace

ShapePtr make_level_set_shape(openvdb::FloatGrid::ConstPtr grid, const IndexFrame& frame) {
  return std::make_shared<LevelSetShape>(std::move(grid), frame);
}

}  // namespace firn
