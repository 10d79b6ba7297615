#include "engine/simulation/block_samples.h"

#include <catch2/catch.hpp>

using namespace firn;

TEST_CASE("every block is measured in its turn, and shares are of all that was", "[costs]") {
  const std::size_t blocks = GENERATE(1, 10, 64, 65, 1000);
  BlockSamples samples;
  std::vector<int> measured(blocks);
  for (int pass = 0; pass < 64; ++pass) {
    samples.begin(blocks, 2);
    std::size_t now = 0;
    for (std::size_t b = 0; b < blocks; ++b)
      if (std::uint64_t* ticks = samples.of(b)) {
        ++measured[b];
        ++now;
        ticks[0] += 30;
        ticks[1] += 10;
      }
    CHECK(now <= blocks / 64 + 1);
    samples.end();
  }
  for (const int times : measured) CHECK(times >= 1);
  CHECK(samples.shares() == std::vector<double>{0.75, 0.25});
}

TEST_CASE("two blocks never share counters", "[costs]") {
  BlockSamples samples;
  samples.begin(200, 3);
  std::uint64_t* before = nullptr;
  for (std::size_t b = 0; b < 200; ++b)
    if (std::uint64_t* ticks = samples.of(b)) {
      if (before != nullptr) CHECK(ticks - before >= 3);
      before = ticks;
    }
  CHECK(before != nullptr);
}

TEST_CASE("a pass of which nothing was measured is its first part's", "[costs]") {
  BlockSamples samples;
  CHECK(samples.shares().empty());
  samples.begin(0, 2);
  samples.end();
  CHECK(samples.shares() == std::vector<double>{1, 0});
}
