#include <bit>

#include <catch2/catch.hpp>

#include "tests/support/simulated.h"
#include "tests/support/threads.h"

using firn::test::Simulated;
using firn::test::with_threads;

namespace {

const std::string kScene = R"(
[simulation]
cell_size = 0.05
duration = 1
[gravity]
acceleration = [0, -9.81, 0]
[materials.snow]
model = "snow_stomakhin_2013"
[materials.jelly]
model = "fixed_corotated"
density = 1000
youngs_modulus = 5e4
poissons_ratio = 0.3
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [0, 0.35, 0], radius = 0.25 }
velocity = [0, -4, 0]
angular_velocity = [0, 0, 200]
[[bodies]]
name = "pad"
material = "jelly"
shape = { type = "box", min = [-0.4, -0.1, -0.3], max = [0.4, 0.05, 0.3] }
[[colliders]]
name = "ground"
shape = { type = "plane", point = [0, -0.1, 0], normal = [0, 1, 0] }
friction = 0.3
[[colliders]]
name = "paddle"
shape = { type = "box", min = [-0.5, -0.05, -0.5], max = [-0.42, 0.6, 0.5] }
contact = "sticky"
keyframes = [ { time = 0, position = [0, 0, 0] }, { time = 1, position = [0.5, 0, 0], rotation = [0, 0, -40] } ]
[domain]
min = [-1, -1, -1]
max = [1, 1, 1]
[output]
attributes = ["F_E", "F_P", "C", "stress"]
)";

// Everything that is written, particle by particle, as bits.
std::vector<std::uint32_t> state(const std::string& overrides, int threads) {
  Simulated run(kScene, {overrides});
  with_threads(threads, [&] {
    for (int n = 0; n < 40; ++n) run->step(run->stable_dt());
  });
  std::vector<std::uint32_t> out;
  for (const char* name : {"P", "v", "F_E", "F_P", "stress"})
    for (float x : run.attribute(name)) out.push_back(std::bit_cast<std::uint32_t>(x));
  const firn::FrameTotals totals = run.totals();
  for (double x : {totals.kinetic, totals.elastic, totals.dissipated, totals.momentum[1], run->time()}) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    out.push_back(static_cast<std::uint32_t>(bits));
    out.push_back(static_cast<std::uint32_t>(bits >> 32));
  }
  REQUIRE(run->sorts() > 1);  // otherwise the order of particles never mattered
  return out;
}

}  // namespace

TEST_CASE("one, two, three and eight threads give the same bits") {
  for (const std::string precision : {"float", "double"}) {
    const auto one = state("simulation.precision=" + precision, 1);
    for (int threads : {2, 3, 8}) {
      INFO(precision << ", " << threads << " threads");
      CHECK(state("simulation.precision=" + precision, threads) == one);
    }
  }
}

TEST_CASE("another seed gives other bits") {
  CHECK(state("simulation.seed=1", 2) != state("simulation.seed=2", 2));
}
