#include "tools/cli/study/resample.h"

#include <algorithm>

#include <Eigen/QR>
#include <nanoflann.hpp>
#include <tbb/parallel_for.h>

namespace firn {
namespace {

// Displacement, velocity, stress.
constexpr int kValues = 3 + 3 + 9;
using Values = Eigen::Matrix<double, 1, kValues>;

Values values_of(const BodyPoints& points, std::size_t p) {
  Values out;
  out << points.displacement[p].transpose(), points.velocity[p].transpose(),
      Eigen::Map<const Eigen::Matrix<double, 1, 9>>(points.stress[p].data());
  return out;
}

void put(const Values& values, BodyPoints& points, std::size_t p) {
  points.displacement[p] = values.segment<3>(0).transpose();
  points.velocity[p] = values.segment<3>(3).transpose();
  points.stress[p] = Eigen::Map<const Eigen::Matrix3d>(values.data() + 6);
}

/// Number of polynomials of degree 2 or less.
int basis_size(int dimension, int degree) {
  if (degree == 0) return 1;
  return degree == 1 ? 1 + dimension : (dimension + 1) * (dimension + 2) / 2;
}

/// 1, the coordinates, their products, of which the first `size` count.
Eigen::RowVectorXd basis(const Vec3& x, int dimension, int size) {
  Eigen::RowVectorXd out(basis_size(dimension, 2));
  int k = 0;
  out[k++] = 1;
  for (int i = 0; i < dimension; ++i) out[k++] = x[i];
  for (int i = 0; i < dimension; ++i)
    for (int j = i; j < dimension; ++j) out[k++] = x[i] * x[j];
  return out.head(size);
}

}  // namespace

struct Resampler::Tree {
  // What nanoflann asks of a set of points.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t p, std::size_t axis) const {
    return points.start[p][static_cast<Eigen::Index>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  Tree(const BodyPoints& p, int d) : points(p), dimension(d), index(d, *this) {}

  Values at(const Vec3& x) const {
    // Twice as many as unknowns: a lattice cut at a surface has rows of particles that say the same.
    const auto wanted = static_cast<std::size_t>(2 * basis_size(dimension, 2) + 1);
    std::vector<std::uint32_t> near(std::min(wanted, points.size()));
    std::vector<double> distance2(near.size());
    near.resize(index.knnSearch(x.data(), near.size(), near.data(), distance2.data()));
    int degree = 2;
    while (degree > 0 && static_cast<int>(near.size()) < basis_size(dimension, degree) + 1) --degree;
    return fit(x, near, distance2, basis_size(dimension, degree));
  }

  Values fit(const Vec3& x, const std::vector<std::uint32_t>& near, const std::vector<double>& distance2,
             int size) const {
    const auto n = static_cast<Eigen::Index>(near.size());
    const double radius2 = 1.2 * distance2[near.size() - 1];
    if (radius2 == 0) return values_of(points, near[0]);
    Eigen::MatrixXd A(n, size);
    Eigen::Matrix<double, Eigen::Dynamic, kValues> b(n, kValues);
    for (Eigen::Index k = 0; k < n; ++k) {
      const std::size_t p = near[static_cast<std::size_t>(k)];
      const double weight = 1 - distance2[static_cast<std::size_t>(k)] / radius2;
      A.row(k) = weight * basis((points.start[p] - x) / std::sqrt(radius2), dimension, size);
      b.row(k) = weight * values_of(points, p);
    }
    // Column pivots: what particles in a row leave open becomes zero instead of anything.
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(1e-8);
    qr.compute(A);
    const Eigen::MatrixXd coefficients = qr.solve(b);
    return coefficients.row(0);
  }

  const BodyPoints& points;
  int dimension;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Tree>, Tree, -1, std::uint32_t>
      index;
};

Resampler::Resampler(const BodyPoints& points, int dimension)
    : tree_(std::make_unique<Tree>(points, dimension)) {}
Resampler::~Resampler() = default;
Resampler::Resampler(Resampler&&) noexcept = default;

void Resampler::fill(BodyPoints& out) const {
  tbb::parallel_for(std::size_t{0}, out.size(), [&](std::size_t p) { put(tree_->at(out.start[p]), out, p); });
}

}  // namespace firn
