#include <map>
#include <random>
#include <set>

#include <catch2/catch.hpp>

#include "engine/passes/outboxes.h"
#include "engine/vector/isa.h"

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

TEMPLATE_TEST_CASE_SIG("a node gets what all outboxes that reach it hold for it, as velocity", "[vector]",
                       ((class Real, int D), Real, D), (float, 2), (float, 3), (double, 2), (double, 3)) {
  // Blocks far apart, and so close that most have neighbours on every side.
  const auto [count, spread] = GENERATE(std::pair(12, 200), std::pair(150, 16));
  const BlockLayout<D> layout = some_layout<D>(count, spread);
  Outboxes<Real, D> outboxes;
  outboxes.resize(layout.occupied());
  std::mt19937 random(22);
  // Whole numbers: their sums are exact in every order.
  std::uniform_int_distribution<int> number(-1000, 1000);
  std::vector<LineSet> lines;
  std::map<BlockCoord<D>, Node<Real, D>> expected;
  for (std::size_t b = 0; b < layout.occupied(); ++b) {
    BlockCoord<D> first = first_node<D>(layout.coord(b));
    for (auto& x : first) --x;  // an outbox begins one node below its block
    lines.push_back((random() | LineSet{random()} << 32) & kAllLines<D>);
    for (std::size_t n = 0; n < outboxes.kNodes; ++n) {
      if ((lines[b] >> n / (2 * kBlockEdge) & 1) == 0) {  // what an earlier step left
        outboxes.block(b)[n].v[0] = outboxes.block(b)[n].m = std::numeric_limits<Real>::quiet_NaN();
        continue;
      }
      auto& sum =
          expected.try_emplace(node_coord<D>(first, n, 2 * kBlockEdge), Node<Real, D>{}).first->second;
      Node<Real, D>& node = outboxes.block(b)[n];
      for (int d = 0; d < D; ++d) sum.v[d] += node.v[d] = static_cast<Real>(number(random));
      sum.m += node.m = static_cast<Real>(n % 3 == 0 ? 0 : std::abs(number(random)));
    }
  }

  const auto sources = [&](std::size_t b) {
    OutboxViews<Real, D> out;
    for (std::size_t n = 0; n < out.size(); ++n) {
      const std::uint32_t source = layout.sources(b)[n];
      if (source != BlockLayout<D>::kNone) out[n] = {&outboxes.block(source)->v[0], lines[source]};
    }
    return out;
  };
  for (const Isa isa : kIsas) {
    if (!available(isa)) continue;
    CAPTURE(name(isa));
    const auto collect = kernel_table<Real, D>(isa).grid.collect;
    std::size_t found = 0;
    BlockArray<Node<Real, D>, D> grid;
    grid.resize(layout);
    for (std::size_t b = 0; b < layout.size(); ++b) {
      const auto nodes = grid.block(b);
      for (auto& node : nodes)
        node.m = node.v[0] = std::numeric_limits<Real>::quiet_NaN();  // of another step
      const bool used = collect(sources(b), sources(0), &nodes[0].v[0]);
      bool any = false;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        const auto at = expected.find(node_coord<D>(first_node<D>(layout.coord(b)), n, kBlockEdge));
        const Node<Real, D> sum = at == expected.end() ? Node<Real, D>{} : at->second;
        found += at != expected.end();
        any = any || sum.m > 0;
        if (!used) continue;
        REQUIRE(nodes[n].m == sum.m);
        for (int d = 0; d < D; ++d) REQUIRE(nodes[n].v[d] == sum.v[d] / (sum.m > 0 ? sum.m : 1));
      }
      REQUIRE(used == any);
    }
    CHECK(found == expected.size());  // nothing that was put out is lost
  }
}
