#include <cmath>
#include <map>

#include <catch2/catch.hpp>

#include "engine/passes/g2p.h"
#include "engine/passes/grid_update.h"
#include "engine/passes/p2g.h"
#include "engine/passes/sort.h"
#include "tests/support/random_batch.h"

using namespace firn;
using firn::test::random_batch;

namespace {

template <class Real, int D, class Transfer>
struct Grid {
  static constexpr double h = 0.1;
  std::vector<Batch<Real, D>> batches;
  BlockLayout<D> layout;
  GridNodes<Real, D> nodes;

  explicit Grid(std::size_t count, double edge = 10) {
    batches.push_back(random_batch<Real, D>(count, h, edge, kTransferColumns | Transfer::columns));
    sort();
  }
  void sort() {
    Sorter<QuadraticKernel, Real, D>().sort(batches, static_cast<Real>(h), layout, ColumnSet::all());
  }
  void scatter(Real dt) {
    p2g<QuadraticKernel, Transfer, Real, D>(std::span<const Batch<Real, D>>(batches), layout,
                                            static_cast<Real>(h), dt, nodes);
  }
  void update() { grid_update<Transfer, Real, D>(layout, h, 0, {}, Real(0), nodes); }
  Motion gather(Real dt, Real ratio = 1) {
    return g2p<QuadraticKernel, Transfer, Real, D>(std::span<Batch<Real, D>>(batches), layout,
                                                   static_cast<Real>(h), dt, ratio, nodes);
  }
  auto& particles() { return batches[0].particles; }

  Vec3 position(std::size_t block, std::size_t node) {
    return BlockNodes<Real, D>{{}, {}, layout.coord(block), h}.position(node);
  }
};

struct Sums {
  double mass = 0, size = 0;  // size: sum of |m v|, what rounding is measured against
  Vec3 momentum = Vec3::Zero(), angular = Vec3::Zero();
};

template <class Real, int D, class Transfer>
Sums of_grid(Grid<Real, D, Transfer>& g) {
  Sums s;
  for (std::size_t b = 0; b < g.layout.size(); ++b)
    for (std::size_t n = 0; n < kBlockNodes<D>; ++n) {
      const auto& node = g.nodes.nodes.block(b)[n];
      Vec3 q = Vec3::Zero();
      for (int d = 0; d < D; ++d) q[d] = static_cast<double>(node.v[d]);
      s.mass += static_cast<double>(node.m);
      s.momentum += q;
      s.angular += g.position(b, n).cross(q);
    }
  return s;
}

template <class Real, int D, class Transfer>
Sums of_particles(Grid<Real, D, Transfer>& g) {
  Sums s;
  auto& t = g.particles();
  for (std::size_t p = 0; p < t.size(); ++p) {
    const double m = static_cast<double>(t.template view<Column::mass>().load(p));
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();
    for (int d = 0; d < D; ++d) {
      x[d] = static_cast<double>(t.template view<Column::position>().at(p, d));
      v[d] = static_cast<double>(t.template view<Column::velocity>().at(p, d));
    }
    s.mass += m;
    s.momentum += m * v;
    s.size += m * v.norm();
    s.angular += m * x.cross(v);
    if constexpr (Transfer::affine) {
      const auto C = t.template view<Column::affine>().load(p);
      const auto at = [&](int i, int j) { return i < D && j < D ? static_cast<double>(C(i, j)) : 0.0; };
      s.angular += m * g.h * g.h / 4 * Vec3(at(2, 1) - at(1, 2), at(0, 2) - at(2, 0), at(1, 0) - at(0, 1));
    }
  }
  return s;
}

}  // namespace

#define FIRN_ALL_TRANSFERS                                                                            \
  (Grid<double, 3, ApicTransfer>), (Grid<double, 2, ApicTransfer>), (Grid<double, 1, ApicTransfer>),  \
      (Grid<double, 3, MlsTransfer>), (Grid<double, 2, MlsTransfer>), (Grid<float, 3, MlsTransfer>),  \
      (Grid<float, 3, ApicTransfer>), (Grid<double, 3, PicTransfer>), (Grid<double, 2, PicTransfer>), \
      (Grid<double, 3, FlipTransfer>), (Grid<double, 2, FlipTransfer>), (Grid<float, 2, FlipTransfer>)

TEMPLATE_TEST_CASE("P2G conserves mass and momentum, internal forces included", "", FIRN_ALL_TRANSFERS) {
  TestType grid(3000);
  using Real = std::remove_cvref_t<decltype(grid.particles().template view<Column::mass>().load(0))>;
  grid.scatter(Real(0.01));
  const Sums before = of_particles(grid), after = of_grid(grid);
  // Each particle's weights sum to one within a few eps; the errors of 3000 particles add like a random walk.
  const double tolerance = 300 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  CHECK(std::abs(after.mass - before.mass) < tolerance * before.mass);
  CHECK((after.momentum - before.momentum).norm() < tolerance * before.size);
}

TEMPLATE_TEST_CASE("a step without forces conserves momentum", "", FIRN_ALL_TRANSFERS) {
  TestType grid(3000);
  using Real = std::remove_cvref_t<decltype(grid.particles().template view<Column::mass>().load(0))>;
  const Sums before = of_particles(grid);
  grid.scatter(Real(0.01));
  grid.update();
  grid.gather(Real(0.01));
  const Sums after = of_particles(grid);
  const double tolerance = 300 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  CHECK((after.momentum - before.momentum).norm() < tolerance * before.size);
}

TEMPLATE_TEST_CASE("APIC conserves angular momentum over a step", "", (Grid<double, 3, ApicTransfer>),
                   (Grid<double, 2, ApicTransfer>), (Grid<double, 3, MlsTransfer>)) {
  TestType grid(3000);
  const Sums before = of_particles(grid);
  grid.scatter(0.01);
  CHECK((of_grid(grid).angular - before.angular).norm() < 1e-13 * before.size);
  grid.update();
  grid.gather(0.01);
  CHECK((of_particles(grid).angular - before.angular).norm() < 1e-13 * before.size);
}

TEMPLATE_TEST_CASE("APIC reproduces an affine velocity field exactly", "", (Grid<double, 3, ApicTransfer>),
                   (Grid<double, 2, ApicTransfer>), (Grid<double, 3, MlsTransfer>),
                   (Grid<double, 1, ApicTransfer>)) {
  TestType grid(2000);
  auto& t = grid.particles();
  auto C = t.template view<Column::affine>().load(0);  // any matrix and any vector
  auto v0 = t.template view<Column::velocity>().load(0);
  using Velocity = decltype(v0);
  std::vector<Velocity> expected(t.size());
  for (std::size_t p = 0; p < t.size(); ++p) {
    expected[p] = v0 + C * t.template view<Column::position>().load(p);
    t.template view<Column::velocity>().store(p, expected[p]);
    t.template view<Column::affine>().store(p, C);
    t.template view<Column::stress>().store(p, 0.0 * t.template view<Column::stress>().load(p));
    t.template view<Column::elastic_deformation>().store(p, decltype(C)::identity());
  }
  grid.scatter(0.01);
  grid.update();
  grid.gather(0.01);
  for (std::size_t p = 0; p < t.size(); ++p) {
    const auto v = t.template view<Column::velocity>().load(p);
    REQUIRE(norm(v - expected[p]) < 1e-13);
    // C is a difference of velocities over h = 0.1; F is 1 + dt grad v.
    REQUIRE(std::sqrt(frobenius2(t.template view<Column::affine>().load(p) - C)) < 1e-11);
    const auto F = t.template view<Column::elastic_deformation>().load(p);
    REQUIRE(std::sqrt(frobenius2(F - (decltype(C)::identity() + 0.01 * C))) < 1e-13);
  }
}

TEST_CASE("FLIP without forces leaves every particle its own velocity") {
  Grid<double, 2, FlipTransfer> grid(1000);
  auto& t = grid.particles();
  std::vector<Vector<double, 2>> before(t.size());
  for (std::size_t p = 0; p < t.size(); ++p) {
    before[p] = t.view<Column::velocity>().load(p);
    t.view<Column::stress>().store(p, Matrix<double, 2>::zero());
  }
  grid.scatter(0.01);
  grid.update();
  grid.gather(0.01);
  for (std::size_t p = 0; p < t.size(); ++p)
    REQUIRE(norm(t.view<Column::velocity>().load(p) - before[p]) == 0.0);
}

TEMPLATE_TEST_CASE("a uniform stress on a regular lattice leaves interior nodes without force", "",
                   (Grid<double, 3, ApicTransfer>), (Grid<double, 2, PicTransfer>)) {
  TestType grid(1);
  constexpr int D = std::remove_cvref_t<decltype(grid.layout.coord(0))>().size();
  const int per_axis = 16;
  auto& t = grid.particles();
  const auto tau = t.template view<Column::stress>().load(0);
  grid.batches[0] =
      random_batch<double, D>(static_cast<std::size_t>(power(per_axis, D)), grid.h, 8, t.columns());
  for (std::size_t p = 0; p < grid.particles().size(); ++p) {
    auto& table = grid.particles();
    std::size_t rest = p;
    for (int d = 0; d < D; ++d, rest /= per_axis)
      table.template view<Column::position>().at(p, d) =
          (static_cast<double>(rest % per_axis) + 0.5) * grid.h / 2;
    table.template view<Column::velocity>().store(p, Vector<double, D>::zero());
    if (table.columns().has(Column::affine))
      table.template view<Column::affine>().store(p, Matrix<double, D>::zero());
    table.template view<Column::stress>().store(p, tau);
    table.template view<Column::volume>().store(p, std::pow(grid.h / 2, D));
  }
  grid.sort();
  grid.scatter(1.0);
  const double scale = std::pow(grid.h, D - 1);  // |f| of a single cell face under unit stress
  int interior = 0;
  double surface = 0;
  for (std::size_t b = 0; b < grid.layout.size(); ++b)
    for (std::size_t n = 0; n < kBlockNodes<D>; ++n) {
      const Vec3 x = grid.position(b, n) / grid.h;
      bool inside = true;
      for (int d = 0; d < D; ++d) inside = inside && x[d] > 1.4 && x[d] < 6.6;  // kernel within the lattice
      const double f = norm(grid.nodes.nodes.block(b)[n].v);
      if (inside) REQUIRE(f < 1e-12 * scale);
      surface = std::max(surface, f);
      interior += inside;
    }
  CHECK(interior == power(5, D));
  CHECK(surface > 0.1 * scale);  // the test can see a force
}

TEST_CASE("a particle may drift by almost a cell in any direction before the next sort") {
  // Sorted, moved, then scattered with the old blocks and with new ones: the same nodes up to the order of
  // sums.
  Grid<double, 3, ApicTransfer> old_blocks(2000);
  auto& t = old_blocks.particles();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> drift(-0.95, 0.95);
  for (std::size_t p = 0; p < t.size(); ++p)
    for (int d = 0; d < 3; ++d) t.view<Column::position>().at(p, d) += drift(random) * old_blocks.h;
  Grid<double, 3, ApicTransfer> new_blocks = old_blocks;
  new_blocks.sort();
  old_blocks.scatter(0.01);
  new_blocks.scatter(0.01);
  std::map<std::array<int, 3>, double> mass;
  for (auto* grid : {&old_blocks, &new_blocks})
    for (std::size_t b = 0; b < grid->layout.size(); ++b)
      for (std::size_t n = 0; n < kBlockNodes<3>; ++n) {
        const Vec3 x = (grid->position(b, n) / grid->h).array().round();
        mass[{static_cast<int>(x[0]), static_cast<int>(x[1]), static_cast<int>(x[2])}] +=
            (grid == &old_blocks ? 1 : -1) * grid->nodes.nodes.block(b)[n].m;
      }
  for (const auto& [node, difference] : mass) REQUIRE(std::abs(difference) < 1e-13);
}
