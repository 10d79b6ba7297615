#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/scene/seed_check.h"
#include "tests/support/simulated.h"

using firn::MaterialPoints;
using firn::Vec3;
using firn::test::Simulated;

namespace {

const std::string kBlock = R"(
[simulation]
dimension = 2
cell_size = 0.1
duration = 1
precision = "double"
path = "plain"
max_dt = 1e-3
[materials.rubber]
model = "neo_hookean"
density = 1000
youngs_modulus = 1e4
poissons_ratio = 0.3
[[bodies]]
name = "block"
material = "rubber"
shape = { type = "box", min = [0, 0, 0], max = [0.5, 0.5, 0] }
velocity = ["1 + y", 0, 0]
)";

void steps(Simulated& s, int count, double dt) {
  for (int k = 0; k < count; ++k) s->step(dt);
}

Vec3 momentum(Simulated& s) {
  const auto t = s.totals();
  return {t.momentum[0], t.momentum[1], t.momentum[2]};
}

TEST_CASE("a body force that is the same everywhere is gravity") {
  for (const std::string transfer : {"pic", "flip", "apic"})
    for (const std::string order : {"usl", "usf", "musl"}) {
      CAPTURE(transfer, order);
      const std::vector<std::string> scheme{"simulation.transfer=" + transfer,
                                            "simulation.stress_order=" + order};
      auto with = [&](const std::string& force) {
        auto out = scheme;
        out.push_back(force);
        return out;
      };
      Simulated pulled(kBlock, with("gravity.acceleration=[1, -9.81, 0]"));
      Simulated forced(kBlock, with("body_force.acceleration=[1, \"-9.81\", 0]"));
      steps(pulled, 20, 1e-3);
      steps(forced, 20, 1e-3);
      const MaterialPoints a = pulled->material_points(), b = forced->material_points();
      double apart = 0;
      for (std::size_t p = 0; p < a.mass.size(); ++p)
        apart =
            std::max({apart, (a.position[p] - b.position[p]).norm(), (a.velocity[p] - b.velocity[p]).norm()});
      CHECK(apart < 1e-12);  // rounding of velocities of 1
    }
}

TEST_CASE("forces change momentum by what they add up to, at their own time and place") {
  // Of the place at the start: 1 everywhere, whatever has moved since.
  Simulated s(kBlock,
              {"body_force.acceleration=[\"X < 0.6 ? 100 * t : 0\", 0, 0]",
               "loads=[{name = 'push', region = {type = 'box', min = [0, 0, 0], max = [0.1, 0.5, 0]}, "
               "force = [0, '7 * t', 0]}]"});
  const Vec3 before = momentum(s);
  const double dt = 1e-3, mass = s.totals().mass;
  steps(s, 10, dt);
  // USL and MUSL take a step's forces at its beginning: 0 + 1 + ... + 9 steps.
  const Vec3 impulse = 45 * dt * dt * Vec3(100 * mass, 7, 0);
  CHECK((momentum(s) - before - impulse).norm() < 1e-12 * before.norm());
}

TEST_CASE("a load acts on the particles that start in its region") {
  Simulated s(kBlock,
              {"bodies.block.velocity=[0, 0, 0]", "simulation.transfer=flip",
               "loads=[{name = 'push', region = {type = 'box', min = [-1, -1, 0], max = [0.1, 1, 0]}, "
               "force = [0, 5, 0]}]"});
  steps(s, 1, 1e-4);
  const MaterialPoints points = s->material_points();
  for (std::size_t p = 0; p < points.mass.size(); ++p) {
    // The quadratic kernel reaches a cell and a half on either side: from particle to node to particle,
    // three.
    if (points.position[p].x() > 0.4) CHECK(points.velocity[p].norm() == 0);
    if (points.position[p].x() < 0.1) CHECK(points.velocity[p].y() > 0);
  }
}

TEST_CASE("a bar that is pulled at both ends stretches by P L / (E A)") {
  // No walls: their first cell would count. The load grows over twenty periods of the slowest mode and ends
  // without a jump, which leaves next to no vibration.
  const std::string bar = R"toml(
[simulation]
dimension = 1
cell_size = 0.025
duration = 4
frame_rate = 0.25
precision = "double"
transfer = "flip"
cfl = 0.5
[materials.m]
model = "neo_hookean"
density = 1
youngs_modulus = 100
poissons_ratio = 0
[[bodies]]
name = "bar"
material = "m"
shape = { type = "box", min = [0, 0, 0], max = [1, 0, 0] }
particles_per_cell = 2
sampling = "lattice"
[[loads]]
name = "left"
region = { type = "box", min = [0, 0, 0], max = [0.025, 0, 0] }
force = ["-0.05 * (1 - cos(pi * t / 4))", 0, 0]
[[loads]]
name = "right"
region = { type = "box", min = [0.975, 0, 0], max = [1, 0, 0] }
force = ["0.05 * (1 - cos(pi * t / 4))", 0, 0]
)toml";
  for (const std::string kernel : {"linear", "gimp", "quadratic", "cubic"}) {
    CAPTURE(kernel);
    Simulated s(bar, {"simulation.kernel=" + kernel});
    while (s->time() < 4) s->step(std::min(s->stable_dt(), 4 - s->time() + 1e-15));
    const MaterialPoints points = s->material_points();
    const auto displacement = [&](std::size_t p) {
      return points.position[p].x() - (static_cast<double>(p) + 0.5) / 80;
    };
    const double stretch = displacement(60) - displacement(20), length = 0.5, P = 0.1;
    // The strain is 1e-3, and neo-Hooke's stress differs from E times it by as much.
    CHECK(stretch == Approx(P * length / 100).epsilon(2e-3));
    CHECK(points.stress[40](0, 0) == Approx(P).epsilon(2e-3));
  }
}

TEST_CASE("a load on no particle is a mistake") {
  const Simulated good(kBlock);
  firn::Plan plan = firn::make_plan(firn::read_scene_text(
      kBlock, "a.toml",
      std::vector<std::string>{
          "loads=[{name = 'push', region = {type = 'box', min = [2, 0, 0], max = [3, 1, 0]}, "
          "force = [0, 1, 0]}]"}));
  std::vector<std::string> warnings;
  CHECK_THROWS_WITH(firn::seed_bodies(plan, warnings), Catch::Contains("loads.push.region: no particle"));
}

TEST_CASE("a particle's volume is that at rest times det F") {
  Simulated s(kBlock, {"output.attributes=[\"F_E\", \"volume\", \"density\"]",
                       "bodies.block.velocity=[\"y - x\", \"x\", 0]"});
  steps(s, 100, 1e-3);
  const std::vector<float> F = s.attribute("F_E"), volume = s.attribute("volume"),
                           density = s.attribute("density");
  const MaterialPoints points = s->material_points();
  double least = 1;
  for (std::size_t p = 0; p < volume.size(); ++p) {
    const float* f = &F[9 * p];
    const double J = double(f[0]) * f[4] - double(f[1]) * f[3], rest = points.mass[p] / 1000;
    least = std::min(least, J);
    CHECK(volume[p] == Approx(rest * J).epsilon(1e-6));  // attributes are floats
    CHECK(density[p] == Approx(1000 / J).epsilon(1e-6));
  }
  CHECK(least < 0.99);  // it did deform
}

TEST_CASE("a velocity given as a formula starts APIC's affine velocity, too") {
  const std::string turning = "bodies.block.velocity=[\"-(y - 0.25)\", \"x - 0.25\", 0]";
  // On a lattice, whose centre is the block's.
  const std::string lattice = "bodies.block.sampling=lattice", four = "bodies.block.particles_per_cell=4";
  Simulated formula(kBlock, {turning, lattice, four});
  Simulated spin(kBlock, {"bodies.block.velocity=[0, 0, 0]", lattice, four,
                          "bodies.block.angular_velocity=[0, 0, 57.29577951308232]"});
  const auto a = formula.totals(), b = spin.totals();
  // The formula's gradient comes from differences, good to 1e-10.
  CHECK(a.angular[2] == Approx(b.angular[2]).epsilon(1e-9));
  CHECK(a.kinetic == Approx(b.kinetic).epsilon(1e-9));
  // Without C, APIC lacks h^2 / 4 of the inertia, here 1.5 %.
  Simulated pic(kBlock, {turning, lattice, four, "simulation.transfer=pic"});
  CHECK(pic.totals().angular[2] < 0.99 * a.angular[2]);
}

}  // namespace
