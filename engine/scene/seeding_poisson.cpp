#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/scene/seeding_hash.h"
#include "engine/scene/seeding_patterns.h"

namespace firn {
namespace {

/// Points times distance^D per volume. In 3D 8 * 0.415^3 = 0.572, which is 78 % of the jamming density of
/// random sequential addition (0.7336); the same share of 0.6965 in 2D and of 0.7476 in 1D.
constexpr double kCrowding[] = {0, 0.583, 0.543, 8 * 0.415 * 0.415 * 0.415};

/// Points in the periodic block: enough that its repetition does not show, few enough to fill it in a moment.
constexpr double kBlockPoints[] = {0, 4096, 16384, 32768};

/// The unit torus with points, in bins not smaller than the distance between them.
class Torus {
 public:
  Torus(int dimension, double distance)
      : dimension_(dimension),
        bins_(std::max<std::int64_t>(1, static_cast<std::int64_t>(1 / distance))),
        head_(static_cast<std::size_t>(std::pow(bins_, dimension)), -1) {}

  /// Adds `x` unless a point is nearer than `distance`.
  bool add(const Vec3& x, double distance) {
    if (!has_room(x, distance)) return false;
    const std::size_t bin = bin_at(bin_of(x));
    next_.push_back(head_[bin]);
    head_[bin] = static_cast<std::int64_t>(points_.size());
    points_.push_back(x);
    return true;
  }

  const std::vector<Vec3>& points() const { return points_; }

 private:
  CellIndex bin_of(const Vec3& x) const {
    CellIndex bin{0, 0, 0};
    for (int axis = 0; axis < dimension_; ++axis) {
      bin[static_cast<std::size_t>(axis)] =
          std::min(static_cast<std::int64_t>(x[axis] * static_cast<double>(bins_)), bins_ - 1);
    }
    return bin;
  }

  std::size_t bin_at(const CellIndex& bin) const {
    std::int64_t at = 0;
    for (int axis = dimension_ - 1; axis >= 0; --axis) {
      at = at * bins_ + (bin[static_cast<std::size_t>(axis)] + bins_) % bins_;
    }
    return static_cast<std::size_t>(at);
  }

  bool has_room(const Vec3& x, double distance) const {
    const CellIndex bin = bin_of(x);
    const std::int64_t ry = dimension_ > 1 ? 1 : 0, rz = dimension_ > 2 ? 1 : 0;
    for (std::int64_t k = -rz; k <= rz; ++k) {
      for (std::int64_t j = -ry; j <= ry; ++j) {
        for (std::int64_t i = -1; i <= 1; ++i) {
          for (std::int64_t p = head_[bin_at({bin[0] + i, bin[1] + j, bin[2] + k})]; p >= 0;
               p = next_[static_cast<std::size_t>(p)]) {
            Vec3 d = x - points_[static_cast<std::size_t>(p)];
            d = (d.array() - d.array().round()).matrix();
            if (d.squaredNorm() < distance * distance) return false;
          }
        }
      }
    }
    return true;
  }

  int dimension_;
  std::int64_t bins_;
  std::vector<std::int64_t> head_, next_;
  std::vector<Vec3> points_;
};

std::vector<Vec3> filled_torus(int dimension, std::size_t count, double distance, std::uint64_t key) {
  Torus torus(dimension, distance);
  // The jam is far, so this loop is short; giving way a little guarantees that it ends.
  const std::uint64_t patience = 1000 * count;
  for (std::uint64_t trial = 0; torus.points().size() < count; ++trial) {
    if (trial % patience == patience - 1) distance *= 0.99;
    Vec3 x = unit_vector(mixed(key + mixed(trial)));
    for (int axis = dimension; axis < 3; ++axis) x[axis] = 0;
    torus.add(x, distance);
  }
  return torus.points();
}

/// The torus stretched over `period` cells along each axis, its points by cell.
class Block {
 public:
  Block(int dimension, double per_cell, std::uint64_t key) {
    period_ = std::max<std::int64_t>(
        1,
        static_cast<std::int64_t>(std::round(std::pow(kBlockPoints[dimension] / per_cell, 1.0 / dimension))));
    for (int axis = 0; axis < 3; ++axis)
      periods_[static_cast<std::size_t>(axis)] = axis < dimension ? period_ : 1;
    const double cells = std::pow(static_cast<double>(period_), dimension);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(cells * per_cell)));
    const double distance = poisson_distance(dimension, 1.0 / static_cast<double>(period_), per_cell);
    cells_.resize(static_cast<std::size_t>(cells));
    for (const Vec3& unit : filled_torus(dimension, count, distance, key)) {
      const Vec3 x = unit * static_cast<double>(period_);
      cells_[at({floor(x.x()), floor(x.y()), floor(x.z())})].push_back(x.array() - x.array().floor());
    }
  }

  /// Positions within the cell, from 0 to 1.
  const std::vector<Vec3>& points(const CellIndex& cell) const { return cells_[at(cell)]; }

 private:
  static std::int64_t floor(double x) { return static_cast<std::int64_t>(std::floor(x)); }
  std::size_t at(const CellIndex& cell) const {
    std::int64_t index = 0;
    for (std::size_t axis = 3; axis-- > 0;) {
      const std::int64_t n = periods_[axis];
      index = index * n + ((cell[axis] % n) + n) % n;
    }
    return static_cast<std::size_t>(index);
  }

  std::int64_t period_;
  CellIndex periods_;
  std::vector<std::vector<Vec3>> cells_;
};

}  // namespace

double poisson_distance(int dimension, double cell_size, double per_cell) {
  return cell_size * std::pow(kCrowding[dimension] / per_cell, 1.0 / dimension);
}

PointPattern poisson_pattern(int dimension, double cell_size, double per_cell, std::uint64_t key) {
  const auto block = std::make_shared<const Block>(dimension, per_cell, key);
  const auto points_of = [=](const CellIndex& cell, std::vector<Vec3>& out) {
    for (const Vec3& fraction : block->points(cell)) {
      Vec3 x = Vec3::Zero();
      for (int axis = 0; axis < dimension; ++axis) {
        x[axis] = (static_cast<double>(cell[static_cast<std::size_t>(axis)]) + fraction[axis]) * cell_size;
      }
      out.push_back(x);
    }
  };
  return {cell_size, points_of};
}

}  // namespace firn
