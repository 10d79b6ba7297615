// A state that means nothing any more ends the run on the vectorised path as it does on the plain one.
#include "tests/engine/simulation/vector_scene.h"

using namespace firn;
using namespace firn::test;

namespace {

const std::string kScene = R"(
[simulation]
cell_size = 0.1
duration = 1
[materials.rubber]
model = "neo_hookean"
density = 1000
youngs_modulus = 1e4
poissons_ratio = 0.3
[[bodies]]
name = "ball"
material = "rubber"
shape = { type = "sphere", center = [0, 0, 0], radius = 0.6 }
velocity = [0.1, 0.2, 0]
[[bodies]]
name = "speck"
material = "rubber"
shape = { type = "sphere", center = [5, 5, 0], radius = 0.2 }
)";

/// The message that steps of 1 ms, announced ahead, end with.
std::string message(Simulated& run, int steps, double last = 1e-3) {
  try {
    for (int n = 1; n <= steps; ++n) run->step(1e-3, n < steps ? 1e-3 : last);
    run->step(last);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::numerics);
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("the vectorised path names the particle that is not finite or too fast") {
  const int dimension = GENERATE(2, 3);
  const std::string precision = GENERATE("float", "double");
  // No number; beyond the square's range; 1e6 cells a step; at half that, out of reach some steps later.
  const auto [speed, steps] = GENERATE(std::pair(std::numeric_limits<double>::quiet_NaN(), 1),
                                       std::pair(1e30, 1), std::pair(-1.2e8, 1), std::pair(4e7, 3));
  CAPTURE(dimension, precision, speed);
  std::size_t speck = 0;
  Simulated run(kScene, settings(precision, "apic", dimension, "automatic"), FIRN_TEST_DATA,
                [&, speed = speed](std::vector<Seeds>& seeds) {
                  speck = seeds[0].position.size();
                  seeds[1].position.resize(1);
                  seeds[1].velocity = {Vec3(0, speed, 0)};
                });
  REQUIRE(run.plan.path.isa);
  CHECK_THAT(message(run, steps),
             Catch::Contains("(1 of ") &&
                 Catch::Contains("particle " + std::to_string(speck) + " of material 'rubber'"));
}

TEST_CASE("a fused step that ends in nonsense is noticed by the next one") {
  const double last = GENERATE(1e9, 1e39);  // out of the grid's reach; beyond float
  Simulated run(kScene, settings("float", "mls", 3, "automatic"));
  REQUIRE(run.plan.path.isa);
  CHECK_THAT(message(run, 5, last), Catch::Contains("particle ") && Catch::Contains("of material 'rubber'"));
}
