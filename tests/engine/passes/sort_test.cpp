#include "engine/passes/sort.h"

#include <algorithm>
#include <map>
#include <numeric>

#include <catch2/catch.hpp>

#include "tests/support/random_batch.h"
#include "tests/support/threads.h"

using namespace firn;
using firn::test::random_batch;
using firn::test::with_threads;

namespace {

constexpr double kCell = 0.07;  // no binary fraction, so that cells of border points are a matter of rounding
const ColumnSet kColumns = kTransferColumns | ColumnSet{Column::affine, Column::plastic_deformation};

template <class Real, int D>
using Batches = std::vector<Batch<Real, D>>;

/// Particles between and on the borders of cells, on both sides of the origin; with no particle and one too.
template <class Real, int D>
Batches<Real, D> some_batches() {
  Batches<Real, D> out;
  for (const std::size_t count : {5000, 0, 1, 700})
    out.push_back(random_batch<Real, D>(count, kCell, 14, kColumns, static_cast<unsigned>(count) + 1));
  for (auto& batch : out)
    for (std::size_t p = 0; p < batch.particles.size(); p += 3)
      for (int d = 0; d < D; ++d) {
        Real& x = batch.particles.template view<Column::position>().at(p, d);
        x = std::round(2 * x / static_cast<Real>(kCell)) / 2 * static_cast<Real>(kCell);
      }
  return out;
}

/// Block, then cell within it: the first node of the particle's kernel.
template <class Real, int D>
std::array<std::array<int, D>, 2> place(const Vector<Real, D>& x) {
  std::array<std::array<int, D>, 2> out;
  for (std::size_t d = 0; d < D; ++d) {
    const Real cells = x[static_cast<int>(d)] * (Real(1) / static_cast<Real>(kCell));
    const int cell = static_cast<int>(std::floor(cells - Real(0.5)));
    out[0][d] = static_cast<int>(std::floor(cell / 4.0));
    out[1][d] = cell - 4 * out[0][d];
  }
  return out;
}

/// The order that a stable sort gives.
template <class Real, int D>
std::vector<std::uint32_t> expected_ids(const Batch<Real, D>& batch) {
  const auto position = batch.particles.template view<Column::position>();
  std::vector<std::size_t> order(batch.particles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return place(position.load(a)) < place(position.load(b));
  });
  std::vector<std::uint32_t> ids;
  for (const std::size_t p : order) ids.push_back(batch.particles.id()[p]);
  return ids;
}

/// All numbers of the columns, particle after particle.
template <class Real, int D>
std::vector<Real> values(const Batch<Real, D>& batch, ColumnSet columns) {
  auto table = batch.particles;
  const auto pointers = table.pointers();
  std::vector<Real> out;
  for (std::size_t p = 0; p < table.size(); ++p)
    for (int c = 0; c < kColumnCount; ++c) {
      const int width = components(static_cast<Column>(c), D);
      if (!columns.has(static_cast<Column>(c))) continue;
      for (int k = 0; k < width; ++k)
        out.push_back(pointers[static_cast<std::size_t>(c)][tile_index(p, k, width)]);
    }
  return out;
}

template <class Real, int D>
std::vector<std::uint32_t> ids(const Batch<Real, D>& batch) {
  return {batch.particles.id().begin(), batch.particles.id().end()};
}

template <class Real, int D>
using CellSorter = Sorter<QuadraticKernel, Real, D>;

template <class Real, int D>
void sort(Batches<Real, D>& batches, BlockLayout<D>& layout) {
  CellSorter<Real, D>().sort(batches, static_cast<Real>(kCell), layout, ColumnSet::all());
}

}  // namespace

#define FIRN_REALS_AND_DIMENSIONS \
  ((class Real, int D), Real, D), (float, 1), (float, 2), (float, 3), (double, 2), (double, 3)

TEMPLATE_TEST_CASE_SIG("particles come out in the order of a stable sort by block and cell", "",
                       FIRN_REALS_AND_DIMENSIONS) {
  Batches<Real, D> batches = some_batches<Real, D>();
  const Batches<Real, D> before = batches;
  BlockLayout<D> layout;
  sort(batches, layout);
  for (std::size_t k = 0; k < batches.size(); ++k) {
    CHECK((ids(batches[k]) == expected_ids(before[k])));  // in brackets: not to be printed
    // The ids count from 0: every value came along with its id.
    const auto was = values(before[k], kColumns), is = values(batches[k], kColumns);
    const std::size_t width = static_cast<std::size_t>(kColumns.reals(D));
    for (std::size_t p = 0; p < batches[k].particles.size(); ++p)
      REQUIRE(std::equal(is.begin() + static_cast<std::ptrdiff_t>(p * width),
                         is.begin() + static_cast<std::ptrdiff_t>((p + 1) * width),
                         was.begin() + static_cast<std::ptrdiff_t>(batches[k].particles.id()[p] * width)));
  }
}

TEMPLATE_TEST_CASE_SIG("each block's share is the particles whose kernels begin in it", "",
                       FIRN_REALS_AND_DIMENSIONS) {
  Batches<Real, D> batches = some_batches<Real, D>(), elsewhere = batches;
  for (std::size_t p = 0; p < elsewhere[0].particles.size(); ++p)
    elsewhere[0].particles.template view<Column::position>().at(p, 0) += Real(30 * kCell);
  BlockLayout<D> layout;
  CellSorter<Real, D> sorter;
  sorter.sort(elsewhere, static_cast<Real>(kCell), layout, ColumnSet::all());  // leaves nothing behind
  sorter.sort(batches, static_cast<Real>(kCell), layout, ColumnSet::all());
  std::vector<std::size_t> seen(layout.occupied());
  for (const auto& batch : batches) {
    CHECK(batch.block_begin.size() == layout.occupied() + 1);
    CHECK(batch.block_begin.front() == 0);
    CHECK(batch.block_begin.back() == batch.particles.size());
    for (std::size_t b = 0; b < layout.occupied(); ++b) {
      const auto [first, last] = batch.range(b);
      REQUIRE(first <= last);
      seen[b] += last - first;
      for (std::size_t p = first; p < last; ++p) {
        const auto x = batch.particles.template view<Column::position>().load(p);
        REQUIRE(place(x)[0] == layout.coord(b));
        // The transfers agree: on each axis the first node is one of the block's own, 1 to 4 of the scratch.
        const Stencil<QuadraticKernel, Real, D> stencil(x, Real(0), Real(1) / static_cast<Real>(kCell),
                                                        layout.coord(b));
        for (int d = 0, rest = stencil.first; d < D; ++d, rest /= 8)
          REQUIRE((rest % 8 >= 1 && rest % 8 <= 4));
      }
    }
  }
  CHECK(std::find(seen.begin(), seen.end(), 0) == seen.end());  // no block is held for nothing
  for (std::size_t b = 0; b + 1 < layout.occupied(); ++b) REQUIRE(layout.coord(b) < layout.coord(b + 1));
}

TEMPLATE_TEST_CASE_SIG("any number of threads sorts alike", "", FIRN_REALS_AND_DIMENSIONS) {
  Batches<Real, D> one = some_batches<Real, D>();
  BlockLayout<D> layout;
  with_threads(1, [&] { sort(one, layout); });
  for (const int threads : {2, 3, 8, 16}) {
    Batches<Real, D> many = some_batches<Real, D>();
    BlockLayout<D> other;
    with_threads(threads, [&] { sort(many, other); });
    INFO(threads << " threads");
    CHECK(other.size() == layout.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      CHECK((ids(many[k]) == ids(one[k])));
      CHECK((many[k].block_begin == one[k].block_begin));
      CHECK((values(many[k], kColumns) == values(one[k], kColumns)));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("columns that lend their memory change nothing in those that are kept", "",
                       FIRN_REALS_AND_DIMENSIONS) {
  const ColumnSet kept = kColumns.without(Column::velocity).without(Column::affine).without(Column::stress);
  Batches<Real, D> all = some_batches<Real, D>(), lent = all;
  BlockLayout<D> layout;
  CellSorter<Real, D> sorter;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> drift(-kCell, kCell);
  // More than once: memory changes hands at every sort.
  for (int round = 0; round < 3; ++round) {
    sorter.sort(all, static_cast<Real>(kCell), layout, ColumnSet::all());
    sorter.sort(lent, static_cast<Real>(kCell), layout, kept);
    for (std::size_t k = 0; k < all.size(); ++k) {
      CHECK((ids(lent[k]) == ids(all[k])));
      CHECK((values(lent[k], kept) == values(all[k], kept)));
      for (std::size_t p = 0; p < all[k].particles.size(); ++p)
        for (int d = 0; d < D; ++d) {
          Real& x = all[k].particles.template view<Column::position>().at(p, d);
          x += static_cast<Real>(drift(random));
          lent[k].particles.template view<Column::position>().at(p, d) = x;
        }
    }
  }
}

TEST_CASE("without any particle there is no block") {
  Batches<float, 3> batches;
  batches.push_back(random_batch<float, 3>(0, kCell, 1, kColumns));
  BlockLayout<3> layout;
  sort(batches, layout);
  CHECK(layout.size() == 0);
  CHECK(batches[0].block_begin == std::vector<std::size_t>{0});
}
