#include "engine/passes/outboxes.h"

#include <map>
#include <random>
#include <set>

#include <catch2/catch.hpp>

using namespace firn;

namespace {

template <int D>
BlockLayout<D> some_layout(int count, std::int32_t spread) {
  std::mt19937 random(21);
  std::uniform_int_distribution<std::int32_t> cell(-spread, spread);
  std::set<std::uint64_t> blocks;
  for (int n = 0; n < count; ++n) {
    std::array<std::int32_t, D> c;
    for (auto& x : c) x = cell(random);
    blocks.insert(block_of_key(cell_key<D>(c)));
  }
  return BlockLayout<D>(std::vector<std::uint64_t>(blocks.begin(), blocks.end()));
}

/// The node `index` of a cube of `edge` nodes an axis, the first of which is `first`.
template <int D>
BlockCoord<D> node_coord(const BlockCoord<D>& first, std::size_t index, std::size_t edge) {
  BlockCoord<D> out;
  for (std::size_t d = D; d-- > 0; index /= edge) out[d] = first[d] + static_cast<int>(index % edge);
  return out;
}
template <int D>
BlockCoord<D> first_node(const BlockCoord<D>& block) {
  BlockCoord<D> out;
  for (std::size_t d = 0; d < D; ++d) out[d] = block[d] * kBlockEdge;
  return out;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a node gets what all outboxes that reach it hold for it, and nothing else", "",
                       ((class Real, int D), Real, D), (float, 2), (float, 3), (double, 2), (double, 3)) {
  // Blocks far apart, and so close that most have neighbours on every side.
  const auto [count, spread] = GENERATE(std::pair(12, 200), std::pair(150, 16));
  const BlockLayout<D> layout = some_layout<D>(count, spread);
  Outboxes<Real, D> outboxes;
  outboxes.resize(layout.occupied());
  std::mt19937 random(22);
  // Whole numbers: their sums are exact in every order.
  std::uniform_int_distribution<int> number(-1000, 1000);
  std::map<BlockCoord<D>, Node<Real, D>> expected;
  for (std::size_t b = 0; b < layout.occupied(); ++b) {
    BlockCoord<D> first = first_node<D>(layout.coord(b));
    for (auto& x : first) --x;  // an outbox begins one node below its block
    for (std::size_t n = 0; n < outboxes.kNodes; ++n) {
      auto& sum =
          expected.try_emplace(node_coord<D>(first, n, 2 * kBlockEdge), Node<Real, D>{}).first->second;
      Node<Real, D>& node = outboxes.block(b)[n];
      for (int d = 0; d < D; ++d) sum.v[d] += node.v[d] = static_cast<Real>(number(random));
      sum.m += node.m = static_cast<Real>(number(random));
    }
  }

  std::size_t found = 0;
  std::vector<Node<Real, D>> nodes(kBlockNodes<D>);
  for (std::size_t b = 0; b < layout.size(); ++b) {
    for (auto& node : nodes) node.m = node.v[0] = std::numeric_limits<Real>::quiet_NaN();  // of another step
    collect<Real, D>(outboxes, layout.sources(b), nodes);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto at = expected.find(node_coord<D>(first_node<D>(layout.coord(b)), n, kBlockEdge));
      const Node<Real, D> sum = at == expected.end() ? Node<Real, D>{} : at->second;
      found += at != expected.end();
      for (int d = 0; d < D; ++d) REQUIRE(nodes[n].v[d] == sum.v[d]);
      REQUIRE(nodes[n].m == sum.m);
    }
  }
  CHECK(found == expected.size());  // nothing that was put out is lost
}
