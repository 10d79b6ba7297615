#include "engine/simulation/run.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/support/simulated.h"

using namespace firn;
using firn::test::Simulated;

namespace {

const std::string kBlock = R"(
[simulation]
dimension = 2
cell_size = 0.1
duration = 0.5
frame_rate = 10
[materials.rubber]
model = "neo_hookean"
density = 1000
youngs_modulus = 1e4
poissons_ratio = 0.3
[[bodies]]
name = "block"
material = "rubber"
particles_per_cell = 4
shape = { type = "box", min = [0, 0, 0], max = [1, 1, 0] }
velocity = [1, 0, 0]
[output]
attributes = ["F_E", "density", "mass", "volume", "stress", "material"]
)";

bool never() {
  return false;
}

}  // namespace

TEST_CASE("frames are hit exactly and counted from one") {
  Simulated run(kBlock);
  std::vector<double> times;
  std::vector<int> frames;
  std::int64_t steps = 0, listened = 0;
  const FrameSink sink = [&](const FrameView& frame) {
    times.push_back(frame.time);
    frames.push_back(frame.frame);
    steps += frame.steps.steps;
    if (frame.frame > 1) CHECK(frame.steps.dt_max <= 0.4 * 0.1 / 1.0);
  };
  REQUIRE(run.plan.frames() == 6);
  CHECK(run_frames(
      *run.simulation, 10, 1, 6, {&sink, 1}, [&](int, double, double) { ++listened; }, never));
  CHECK(frames == std::vector<int>{1, 2, 3, 4, 5, 6});
  for (std::size_t k = 0; k < times.size(); ++k) CHECK(times[k] == static_cast<double>(k) / 10);
  CHECK(steps == listened);
}

TEST_CASE("only the frames asked for reach the sinks") {
  Simulated run(kBlock);
  std::vector<int> frames;
  const FrameSink sink = [&](const FrameView& frame) { frames.push_back(frame.frame); };
  run_frames(
      *run.simulation, 10, 3, 4, {&sink, 1}, [](int, double, double) {}, never);
  CHECK(frames == std::vector<int>{3, 4});
}

TEST_CASE("a run that is asked to stop does so before the next step") {
  Simulated run(kBlock);
  int steps = 0;
  CHECK_FALSE(run_frames(
      *run.simulation, 10, 1, 6, {}, [&](int, double, double) { ++steps; }, [&] { return steps == 3; }));
  CHECK(steps == 3);
}

TEST_CASE("a time step too small for the frame to ever end stops the run with the reason") {
  Simulated run(kBlock, {"bodies.block.velocity=[1e9,0,0]"});
  CHECK_THROWS_WITH(run_frames(
                        *run.simulation, 10, 1, 6, {}, [](int, double, double) {}, never),
                    Catch::Contains("the stable time step has fallen to"));
}

TEST_CASE("the stable step follows cfl h / (|v| + c)") {
  Simulated run(kBlock);
  const double lambda = 1e4 * 0.3 / (1.3 * 0.4), mu = 1e4 / 2.6;
  const double c = std::sqrt((lambda + 2 * mu) / 1000);
  CHECK(run->stable_dt() == Approx(0.4 * 0.1 / (1 + c)).epsilon(1e-6));
  CHECK(Simulated(kBlock, {"simulation.max_dt=1e-4"})->stable_dt() == 1e-4);
}

TEST_CASE("a fast collider shortens the step before it hits anything") {
  const std::string paddle = R"(
[[colliders]]
name = "paddle"
shape = { type = "sphere", center = [9, 9, 0], radius = 0.1 }
keyframes = [ { time = 0, position = [0, 0, 0] }, { time = 0.1, position = [20, 0, 0] } ]
)";
  CHECK(Simulated(kBlock + paddle)->stable_dt() <= 0.4 * 0.1 / 200);
}

TEST_CASE("derived attributes fit the state at rest, and two dimensions are embedded in three") {
  Simulated run(kBlock);
  const auto F = run.attribute("F_E"), density = run.attribute("density"), mass = run.attribute("mass"),
             volume = run.attribute("volume"), stress = run.attribute("stress"), P = run.attribute("P");
  double total = 0;
  for (std::size_t p = 0; p < run->particles(); ++p) {
    for (std::size_t k = 0; k < 9; ++k) {
      REQUIRE(F[9 * p + k] == (k % 4 == 0 ? 1.0F : 0.0F));
      REQUIRE(stress[9 * p + k] == 0.0F);
    }
    REQUIRE(density[p] == Approx(1000).epsilon(1e-6));
    REQUIRE(mass[p] == Approx(1000 * volume[p]).epsilon(1e-6));
    REQUIRE(P[3 * p + 2] == 0.0F);
    total += static_cast<double>(mass[p]);
  }
  CHECK(total == Approx(1000).epsilon(1e-6));  // one square metre
}

TEST_CASE("alpha of a stretched metal is the closed form's, and models without one are told so") {
  // F is the same everywhere: plane pure shear by 1 % in one step, free edges have not been felt yet.
  const std::string metal = "materials.rubber.model='von_mises'";
  const std::vector<std::string> settings = {
      metal, "materials.rubber.sigma_y=10", "output.attributes=['alpha']",
      "bodies.block.velocity=['x', '-y', 0]", "simulation.path='plain'"};
  Simulated run(kBlock, settings);
  run->step(0.01);
  const double mu = 1e4 / 2.6, e = std::log(1.01), dev = std::sqrt(2.0) * e;
  const double q = std::sqrt(6.0) * mu * dev;
  for (const float alpha : run.attribute("alpha"))
    REQUIRE(alpha == Approx((q - 10) / (3 * mu)).epsilon(1e-2));  // exp(e) and 1 - 0.01 are apart by that
  CHECK_THROWS_WITH(Simulated(kBlock, {"output.attributes=['alpha']"}),
                    Catch::Contains("no material of this scene stores what it hardens with"));
}

TEST_CASE("pressure is that of the closed form, with and without a stress beside it") {
  const std::size_t D = GENERATE(2, 3);
  const std::string beside = GENERATE("", ", 'stress'");
  Simulated run(kBlock, {"output.attributes=['pressure', 'F_E'" + beside + "]",
                         "bodies.block.velocity=['-x', '0.5 * y', 0]",
                         D == 2 ? "bodies.block.shape.max=[1, 1, 0]" : "bodies.block.shape.max=[1, 1, 1]",
                         "simulation.cell_size=0.25", "simulation.dimension=" + std::to_string(D)});
  // A step more updates the stress of the F before it, on the vectorised path too.
  for (int n = 0; n < 3; ++n) run->step(0.01);
  const auto pressure = run.attribute("pressure"), F = run.attribute("F_E");
  const double lambda = 1e4 * 0.3 / (1.3 * 0.4), mu = 1e4 / 2.6;
  for (std::size_t p = 0; p < run->particles(); ++p) {
    double squares = 0;
    for (std::size_t k = 0; k < 9; ++k) squares += double(F[9 * p + k]) * double(F[9 * p + k]);
    const Eigen::Matrix3d matrix =
        Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(&F[9 * p]).cast<double>();
    const double J = matrix.determinant();
    const auto d = static_cast<double>(D);
    const double tau = mu * (squares - 3) / d + lambda * std::log(J);  // per axis; F_zz = 1 in 2D
    REQUIRE(pressure[p] == Approx(-tau / J).margin(1e-2));
    REQUIRE(pressure[p] > 10);
  }
}

TEST_CASE("a state that is not finite or out of reach ends the run and names a particle") {
  // Beyond the grid's keys; beyond float.
  for (const double dt : {1e6, 1e39}) {
    Simulated run(kBlock);
    try {
      run->step(dt);
      FAIL("it went unnoticed");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::numerics);
      CHECK(std::string(error.what()).find("particle ") != std::string::npos);
      CHECK(std::string(error.what()).find("'rubber'") != std::string::npos);
    }
  }
}

TEST_CASE("snow keeps the singular values of F_E within its limits in every frame") {
  const std::string snow = R"(
[simulation]
dimension = 2
cell_size = 0.05
duration = 0.2
[materials.snow]
model = "snow_stomakhin_2013"
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [0, 0.3, 0], radius = 0.25 }
velocity = [1, -6, 0]
[[colliders]]
name = "ground"
shape = { type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }
contact = "sticky"
[output]
attributes = ["F_E", "F_P", "Jp"]
)";
  Simulated run(snow);
  float lowest = 1, highest = 1;
  while (run->time() < 0.2) {
    run->step(run->stable_dt());
    const auto F = run.attribute("F_E");
    for (std::size_t p = 0; p < run->particles(); ++p) {
      // Of a 2x2 matrix: s0^2 + s1^2 and s0 s1.
      const double a = F[9 * p], b = F[9 * p + 1], c = F[9 * p + 3], d = F[9 * p + 4];
      const double sum = a * a + b * b + c * c + d * d, product = a * d - b * c;
      const double s0 = (std::sqrt(sum + 2 * product) + std::sqrt(std::max(0.0, sum - 2 * product))) / 2;
      lowest = std::min(lowest, static_cast<float>(product / s0));
      highest = std::max(highest, static_cast<float>(s0));
    }
  }
  // Float: a few units in the last place beyond the limits.
  CHECK(lowest > 0.975F - 1e-6F);
  CHECK(highest < 1.0075F + 1e-6F);
  CHECK(lowest < 0.9751F);  // it did yield
  const auto Jp = run.attribute("Jp");
  CHECK(*std::min_element(Jp.begin(), Jp.end()) < 0.95F);
}
