#include "engine/grid/block_layout.h"

#include <algorithm>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "engine/grid/nodes.h"

using namespace firn;

namespace {

template <int D>
std::vector<std::uint64_t> random_blocks(int count, std::int32_t spread) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int32_t> cell(-spread, spread);
  std::set<std::uint64_t> blocks;
  while (static_cast<int>(blocks.size()) < count) {
    std::array<std::int32_t, D> c;
    for (auto& x : c) x = cell(random);
    blocks.insert(block_of_key(cell_key<D>(c)));
  }
  return {blocks.begin(), blocks.end()};
}

}  // namespace

TEST_CASE("a cell's block is found again from its key, left and right of the origin and at the limits") {
  for (std::int32_t x : {-kMaxCell, -5, -4, -1, 0, 3, 4, kMaxCell - 1}) {
    const std::array<std::int32_t, 3> cell{x, 7, -9};
    const BlockCoord<3> block = block_coord<3>(block_of_key(cell_key<3>(cell)));
    CHECK(block[0] == (x >= 0 ? x / 4 : -((-x + 3) / 4)));
    CHECK(block[1] == 1);
    CHECK(block[2] == -3);
  }
}

TEMPLATE_TEST_CASE_SIG("memory follows the occupied blocks, not their spread", "", ((int D), D), 1, 2, 3) {
  const BlockLayout<D> near(random_blocks<D>(20, 40)), far(random_blocks<D>(20, kMaxCell - 8));
  CHECK(near.occupied() == 20);
  CHECK(far.occupied() == 20);
  CHECK(near.size() <= 20u * kNeighbours<D>);
  CHECK(far.size() <= 20u * kNeighbours<D>);
}

TEMPLATE_TEST_CASE_SIG("no two occupied blocks of a colour share a neighbour", "", ((int D), D), 1, 2, 3) {
  const BlockLayout<D> layout(random_blocks<D>(D == 1 ? 20 : 200, 60));
  std::size_t coloured = 0;
  for (const auto& colour : layout.colours()) {
    std::set<std::uint32_t> touched;
    for (std::uint32_t b : colour)
      for (std::uint32_t n : layout.neighbours(b)) REQUIRE(touched.insert(n).second);
    coloured += colour.size();
  }
  CHECK(coloured == layout.occupied());
}

TEMPLATE_TEST_CASE_SIG("neighbours stand where their place in the list says", "", ((int D), D), 1, 2, 3) {
  const BlockLayout<D> layout(random_blocks<D>(D == 1 ? 20 : 100, 60));
  for (std::size_t b = 0; b < layout.occupied(); ++b)
    for (int n = 0; n < kNeighbours<D>; ++n) {
      const BlockCoord<D>& c = layout.coord(layout.neighbours(b)[static_cast<std::size_t>(n)]);
      for (int d = D - 1, rest = n; d >= 0; --d, rest /= 3)
        REQUIRE(c[static_cast<std::size_t>(d)] ==
                layout.coord(b)[static_cast<std::size_t>(d)] + rest % 3 - 1);
    }
}

TEMPLATE_TEST_CASE_SIG("a scratch shows the nodes from one below a block to three above it", "", ((int D), D),
                       1, 2, 3) {
  const BlockLayout<D> layout(random_blocks<D>(1, 30));
  BlockArray<BlockCoord<D>, D> grid;
  grid.reset(layout);
  for (std::size_t b = 0; b < layout.size(); ++b)
    for (std::size_t n = 0; n < kBlockNodes<D>; ++n) {
      std::size_t rest = n;
      for (int d = D - 1; d >= 0; --d, rest /= kBlockEdge)
        grid.block(b)[n][static_cast<std::size_t>(d)] =
            layout.coord(b)[static_cast<std::size_t>(d)] * kBlockEdge + static_cast<int>(rest % kBlockEdge);
    }
  Scratch<BlockCoord<D>, D> scratch;
  scratch.load(grid, layout.neighbours(0));
  for (int s = 0; s < scratch.kSize; ++s)
    for (int d = D - 1, rest = s; d >= 0; --d, rest /= scratch.kEdge) {
      const auto axis = static_cast<std::size_t>(d);
      REQUIRE(scratch.node[static_cast<std::size_t>(s)][axis] ==
              layout.coord(0)[axis] * kBlockEdge + rest % scratch.kEdge - 1);
    }
}
