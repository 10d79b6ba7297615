// A step of the vectorised path takes no memory once its buffers have grown. A program of its own, for it
// counts what the whole of it takes: `operator new`, and TBB's aligned allocator behind the large arrays.
// What the scheduler takes for its tasks comes from elsewhere and is not counted.
#include <atomic>
#include <cstdlib>
#include <new>

#include <catch2/catch.hpp>
#include <dlfcn.h>
#include <tbb/cache_aligned_allocator.h>

#include "tests/support/simulated.h"
#include "tests/support/threads.h"

namespace {

std::atomic<long> allocations = 0;

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  void* p = nullptr;
  if (posix_memalign(&p, std::max(alignment, sizeof(void*)), size) != 0) throw std::bad_alloc();
  return p;
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}

// Found before TBB's own, which it hands on to.
void* tbb::detail::r1::cache_aligned_allocate(std::size_t size) {
  using Allocate = void* (*)(std::size_t);
  static const Allocate original =
      reinterpret_cast<Allocate>(dlsym(RTLD_NEXT, "_ZN3tbb6detail2r122cache_aligned_allocateEm"));
  ++allocations;
  return original(size);
}

namespace {

using namespace firn;
using namespace firn::test;

// Two materials on their way across the grid, so soft that the steps may be long: the blocks they fill come
// again and again. A collider and walls far off, which are asked all the same.
const std::string kScene = R"(
[simulation]
cell_size = 0.125
duration = 1
path = "automatic"
[materials.snow]
model = "snow_stomakhin_2013"
youngs_modulus = 0.5
[materials.rubber]
model = "neo_hookean"
density = 300
youngs_modulus = 0.5
poissons_ratio = 0.3
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [0.03, 0.02, 0.01], radius = 0.7 }
velocity = [0.625, 0.625, 0]
[[bodies]]
name = "box"
material = "rubber"
shape = { type = "sphere", center = [2.03, 0.02, 0.01], radius = 0.4 }
velocity = [0.625, 0.625, 0]
[[colliders]]
name = "far"
shape = { type = "sphere", center = [0, 0, 90], radius = 1 }
keyframes = [ { time = 0, position = [0, 0, 0] }, { time = 1, position = [0.1, 0, 0] } ]
[domain]
min = [-100, -100, -100]
max = [100, 100, 100]
)";

// Announced ahead, 0.4 cells long: two of them for a sort, ten for a block.
void fused_steps(Simulated& run, int count) {
  for (int n = 0; n < count; ++n) run->step(0.08, 0.08);
}

}  // namespace

TEST_CASE("fused steps and their sorts allocate nothing once the buffers have grown") {
  // Not PIC, which has no column to lend to a sort: it takes a buffer for the while.
  const std::string transfer = GENERATE("mls", "apic"), precision = GENERATE("float", "double");
  CAPTURE(transfer, precision);
  with_threads(1, [&] {
    Simulated run(kScene, {"simulation.transfer=" + transfer, "simulation.precision=" + precision});
    REQUIRE(run.plan.path.isa);
    const long before = allocations;
    CHECK(before > 0);  // they are counted
    // Thrice across a block along both axes: each of the two layouts has then seen every phase.
    fused_steps(run, 60);
    const long warm = allocations;
    CHECK(warm > before);
    const std::size_t bytes = run->bytes(), sorts = run->sorts();
    fused_steps(run, 60);
    CHECK(run->sorts() >= sorts + 20);
    CHECK(allocations - warm == 0);
    CHECK(run->bytes() == bytes);
  });
}
