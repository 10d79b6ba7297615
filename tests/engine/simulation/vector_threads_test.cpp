// The vectorised path promises the same bits for any number of threads (engine/passes/outboxes.h).
#include <bit>

#include "tests/engine/simulation/vector_scene.h"
#include "tests/support/threads.h"

using namespace firn;
using namespace firn::test;

namespace {

struct Played {
  std::vector<std::uint32_t> bits;  // of everything that is written, frame after frame
  std::size_t sorts, blocks;
};

void append(std::vector<std::uint32_t>& out, Simulated& run) {
  for (const char* name : {"P", "v", "F_E", "stress", "Jp"})
    for (const float x : run.attribute(name)) out.push_back(std::bit_cast<std::uint32_t>(x));
  const FrameTotals totals = run.totals();
  for (const double x : {totals.dissipated, totals.elastic, run->stable_dt(), run->time()}) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    out.push_back(static_cast<std::uint32_t>(bits));
    out.push_back(static_cast<std::uint32_t>(bits >> 32));
  }
}

/// Steps announced ahead, some of them shortened, with frames in between.
Played play(int dimension, int threads) {
  return with_threads(threads, [&] {
    Simulated run(collision_scene(dimension, 2e4), settings("float", "apic", dimension, "automatic"));
    Played out;
    double dt = run->stable_dt();
    for (int n = 1; n <= 160; ++n) {
      const bool frame = n % 40 == 0;
      double next = frame ? 0 : 0.9 * run->stable_dt();
      run->step(dt, next);
      if (n % 7 == 3 && !frame) run->shorten(next *= 0.8);
      if (frame) append(out.bits, run);
      dt = frame ? run->stable_dt() : next;
    }
    out.sorts = run->sorts();
    out.blocks = run->blocks();
    return out;
  });
}

}  // namespace

TEST_CASE("on the vectorised path, 1, 2, 3, 5, 8 and 16 threads give the same bits") {
  const int dimension = GENERATE(2, 3);
  const Played one = play(dimension, 1);
  REQUIRE(one.sorts > 3);  // otherwise the order of particles never mattered
  REQUIRE(one.blocks > 20);
  for (const int threads : {2, 3, 5, 8, 16}) {
    INFO("dimension " << dimension << ", " << threads << " threads");
    CHECK((play(dimension, threads).bits == one.bits));  // in brackets: not to be printed
  }
}
