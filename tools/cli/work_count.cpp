#include "tools/cli/work_count.h"

#include "engine/base/check.h"
#include "engine/vector/kernels.h"
#include "materials/model_info.h"
#include "tools/cli/counting_lane.h"

namespace firn {
namespace {

/// Operations on whole rows, three nodes each, by what they serve: the value itself, the affine moments, the
/// gradient of the kernel.
struct RowWork {
  int value, moments, gradient;
};

// A sum with three weights is 3 * and 2 +.
// 3D, value: along y for each of three x, then along x, then the weight along z: 3*5 + 5 + 1.
//     moments: along y for each x, and along x, differences of products at hand: 3 + 1; y's sum along x: 5;
//     the weight along z on two of them: 2.  gradient: along y for each x 15, along x 5 and 5, along z 3.
// 2D, value: 5 + 1.  moments: 1 + 1.  gradient: 5 + 1 and 1.
constexpr RowWork kGather3{21, 11, 28}, kGather2{6, 2, 7};

// 3D, value: the weight along z, along x 3, along y and onto the nine rows of nodes 9*2.
//     moments: along z 2; weights along z 2, along y 3; additions on the outer rows 2 + 6.
//     gradient: along z 2; weights along z 2, along y 3; additions 3*2 + 9*2.
// 2D, value: 1 + 3, onto the rows 3.  moments: 2 + 1 + 2.  gradient: 2 + 1 + 3*2.
constexpr RowWork kScatter3{22, 15, 31}, kScatter2{7, 5, 9};

template <class Real, int D, class Model>
std::int64_t update_flops(const Model& model) {
  using L = CountingLane<Real>;
  auto point = model.template at_rest<L, D>();
  // Strained and sheared by less than a percent, as most particles are.
  point.visit([](auto column, auto& F) {
    if constexpr (info(column()).rank == Rank::matrix)
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) F(i, j) = L((i == j ? 1 : 0) + 1e-3 * (1 + 2 * i - j));
  });
  L::flops = 0;
  model.update(point, L(1e-4));
  return L::flops;
}

}  // namespace

int transfer_flops(int dimension, Transfer transfer) {
  FIRN_CHECK(dimension == 2 || dimension == 3);
  const int D = dimension, row = 3 * D;
  const bool affine = transfer != Transfer::pic, gradient = transfer != Transfer::mls;
  const RowWork gather = D == 3 ? kGather3 : kGather2, scatter = D == 3 ? kScatter3 : kScatter2;

  // Per axis: x/h, the offset 3, three weights 8; before the gather and, where the particle moved to, again.
  int flops = 2 * 12 * D;
  // Rows hold a velocity a node; three nodes are added up with 2 D, the moment along the last axis with D.
  flops += gather.value * row + 2 * D;
  if (affine) flops += gather.moments * row + 2 * D * (D - 1) + D;
  if (gradient) flops += gather.gradient * row + 2 * D * D;
  // C = 4/h (B - f v), dt grad v, x + dt v, F + (dt grad v) F.
  if (affine) flops += 3 * D * D;
  flops += D * D + 2 * D + 2 * D * D * D;
  // Impulse of the stress T, momentum b; A = m h C (and 4 T where it carries the forces), b - A f.
  flops += 1 + D * D + D;
  if (affine) flops += 1 + D * D + 2 * D * D;
  if (!gradient) flops += 2 * D * D;
  // Of what is scattered only the value has a mass.
  flops += scatter.value * 3 * (D + 1);
  if (affine) flops += scatter.moments * row;
  if (gradient) flops += scatter.gradient * row;
  return flops;
}

std::int64_t update_flops(const Material& material, int dimension, Precision precision) {
  FIRN_CHECK(dimension == 2 || dimension == 3);
  return std::visit(
      [&](const auto& model) {
        if (precision == Precision::single)
          return dimension == 2 ? update_flops<float, 2>(model) : update_flops<float, 3>(model);
        return dimension == 2 ? update_flops<double, 2>(model) : update_flops<double, 3>(model);
      },
      material);
}

Work count_work(const Plan& plan, std::span<const std::size_t> particles, std::size_t occupied_blocks) {
  const SimulationDescription& s = plan.scene.simulation;
  const int real = s.precision == Precision::single ? sizeof(float) : sizeof(double);
  const int outbox = (s.dimension == 2 ? kOutboxNodes<2> : kOutboxNodes<3>)*kNodeReals * real;
  constexpr ColumnSet kMoved{Column::position}, kRead{Column::mass, Column::volume};
  Work sum;
  double count = 0;
  for (std::size_t b = 0; b < particles.size(); ++b) {
    const BatchPlan& batch = plan.batches[b];
    const auto n = static_cast<double>(particles[b]);
    const ColumnSet updated = kMoved | find_model(batch.model)->columns;
    count += n;
    sum.flops += n * static_cast<double>(transfer_flops(s.dimension, s.transfer) +
                                         update_flops(batch.law, s.dimension, s.precision));
    sum.bytes += n * real * (2 * updated.reals(s.dimension) + kRead.reals(s.dimension));
  }
  sum.bytes += 2.0 * outbox * static_cast<double>(occupied_blocks);
  return {sum.flops / count, sum.bytes / count};
}

}  // namespace firn
