#include "tools/cli/weight_storage.h"

#include <limits>

#include <catch2/catch.hpp>

#include "engine/passes/g2p.h"
#include "engine/passes/p2g.h"
#include "engine/passes/sort.h"
#include "tests/support/random_batch.h"

using namespace firn;

namespace {

constexpr double kH = 0.1, kDt = 0.01;

template <class Real>
using Numbers = std::vector<Real>;

/// Particles left and right of the origin, in several blocks.
template <class Kernel, class Real>
struct Body {
  std::vector<Batch<Real, 3>> batches;
  BlockLayout<3> layout;

  Body() : batches{test::random_batch<Real, 3>(500, kH, 10, kTransferColumns)} {
    Sorter<Kernel, Real, 3>().sort(batches, Real(kH), layout, ColumnSet::all());
  }
};

template <class Real>
Numbers<Real> all(const BlockArray<Node<Real, 3>, 3>& grid, const BlockLayout<3>& layout) {
  Numbers<Real> out;
  for (std::size_t b = 0; b < layout.size(); ++b)
    for (const Node<Real, 3>& node : grid.block(b))
      out.insert(out.end(), {node.v[0], node.v[1], node.v[2], node.m});
  return out;
}

template <class Real>
Numbers<Real> all(const ParticleTable<Real, 3>& table) {
  Numbers<Real> out;
  for (std::size_t p = 0; p < table.size(); ++p)
    for (int i = 0; i < 3; ++i) {
      out.push_back(table.template view<Column::velocity>().at(p, i));
      for (int j = 0; j < 3; ++j) out.push_back(table.template view<Column::affine>().load(p)(i, j));
    }
  return out;
}

template <class Real>
struct Results {
  Numbers<Real> nodes, particles;
};

template <class Weights, class Kernel, class Real>
Results<Real> passes_with(const Body<Kernel, Real>& body) {
  const Batch<Real, 3>& batch = body.batches.front();
  Weights weights(batch, body.layout, Real(kH));
  weights.prepare();
  BlockArray<Node<Real, 3>, 3> grid;
  scatter_with(weights, batch, body.layout, Real(kH), Real(kDt), grid);
  ParticleTable<Real, 3> out({Column::velocity, Column::affine}, batch.particles.size());
  gather_with(weights, batch, body.layout, Real(kH), grid, out);
  return {all(grid, body.layout), all(out)};
}

/// What Firn's own passes make of the same: F was one and dt is h, so that what is added to it is h grad v.
template <class Kernel, class Real>
Results<Real> passes_of_firn(Body<Kernel, Real> body) {
  GridNodes<Real, 3> grid;
  p2g<Kernel, PicTransfer, Real, 3>(std::span<const Batch<Real, 3>>(body.batches), body.layout, Real(kH),
                                    Real(kDt), grid);
  ParticleTable<Real, 3>& particles = body.batches.front().particles;
  const auto F = particles.template view<Column::elastic_deformation>();
  for (std::size_t p = 0; p < particles.size(); ++p) F.store(p, Matrix<Real, 3>::identity());
  g2p<Kernel, PicTransfer, Real, 3>(std::span<Batch<Real, 3>>(body.batches), body.layout, Real(kH), Real(kH),
                                    Real(0), grid);
  ParticleTable<Real, 3> out({Column::velocity, Column::affine}, particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    out.template view<Column::velocity>().store(p, particles.template view<Column::velocity>().load(p));
    out.template view<Column::affine>().store(
        p, (Real(1) / Real(kH)) * (F.load(p) - Matrix<Real, 3>::identity()));
  }
  return {all(grid.nodes, body.layout), all(out)};
}

template <class Kernel, class Real>
void check_that_all_ways_agree() {
  const Body<Kernel, Real> body;
  const auto recomputed = passes_with<RecomputedWeights<Kernel, Real, 3>>(body);
  // The same products of the same factors, added in the same order.
  for (const auto& other : {passes_with<RecomputedByNode<Kernel, Real, 3>>(body),
                            passes_with<WeightsByAxis<Kernel, Real, 3>>(body),
                            passes_with<WeightsByNode<Kernel, Real, 3>>(body)}) {
    CHECK(other.nodes == recomputed.nodes);
    CHECK(other.particles == recomputed.particles);
  }
}

template <class Kernel, class Real>
void check_that_they_are_passes_of_firn() {
  const Body<Kernel, Real> body;
  const auto here = passes_with<RecomputedWeights<Kernel, Real, 3>>(body);
  const auto firn = passes_of_firn(body);
  CHECK(here.nodes == firn.nodes);
  REQUIRE(here.particles.size() == firn.particles.size());
  // The gradient goes through F: what is rounded there is of size 1 + h |grad v|, h grad v up to 10, and is
  // divided by h.
  const double tolerance = 20 * static_cast<double>(std::numeric_limits<Real>::epsilon()) / kH;
  for (std::size_t i = 0; i < here.particles.size(); ++i)
    CHECK(static_cast<double>(here.particles[i]) ==
          Approx(static_cast<double>(firn.particles[i])).margin(tolerance).epsilon(0));
}

}  // namespace

TEST_CASE(
    "stored weights, by node or by axis, give the numbers of weights computed where they are used, to the "
    "bit",
    "[bench]") {
  check_that_all_ways_agree<QuadraticKernel, float>();
  check_that_all_ways_agree<QuadraticKernel, double>();
  check_that_all_ways_agree<LinearKernel, float>();
  check_that_all_ways_agree<LinearKernel, double>();
}

TEST_CASE("the passes that stored weights are measured in are P2G and G2P of the plain path", "[bench]") {
  check_that_they_are_passes_of_firn<QuadraticKernel, float>();
  check_that_they_are_passes_of_firn<QuadraticKernel, double>();
  check_that_they_are_passes_of_firn<LinearKernel, float>();
  check_that_they_are_passes_of_firn<LinearKernel, double>();
}
