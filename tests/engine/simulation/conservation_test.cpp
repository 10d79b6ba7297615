#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/ranges.h>

#include "tests/support/simulated.h"

using firn::test::Simulated;

namespace {

// Bodies that hit each other off centre and break; nothing acts from outside.
const std::string kCollision = R"(
[simulation]
cell_size = 0.1
duration = 1
precision = "double"
[materials.snow]
model = "snow_stomakhin_2013"
[materials.rubber]
model = "neo_hookean"
density = 300
youngs_modulus = 1e5
poissons_ratio = 0.3
[[bodies]]
name = "left"
material = "snow"
shape = { type = "box", min = [-0.55, -0.2, -0.2], max = [-0.05, 0.3, 0.3] }
velocity = [3, 0.2, 0]
[[bodies]]
name = "right"
material = "rubber"
shape = { type = "sphere", center = [0.3, 0.1, 0.0], radius = 0.28 }
velocity = [-3, 0, 0.4]
angular_velocity = [0, 300, 100]
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Every sound choice of kernel, transfer and order, as overrides. No node is ignored: what is on it would be
/// lost.
std::vector<std::vector<std::string>> schemes(const std::vector<std::string>& transfers = {"pic", "flip",
                                                                                           "apic", "mls"}) {
  std::vector<std::vector<std::string>> out;
  for (const std::string& transfer : transfers)
    for (const std::string kernel : {"quadratic", "cubic", "linear", "gimp"})
      for (const std::string order : {"usl", "usf", "musl"}) {
        const bool affine = transfer == "apic" || transfer == "mls";
        if (affine && (kernel == "linear" || kernel == "gimp")) continue;
        out.push_back({"simulation.transfer=" + transfer, "simulation.kernel=" + kernel,
                       "simulation.stress_order=" + order, "simulation.mass_cutoff=0"});
      }
  return out;
}

double size(const double (&v)[3]) {
  return std::hypot(v[0], v[1], v[2]);
}
double distance(const double (&a)[3], const double (&b)[3]) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

TEST_CASE("every step of every scheme conserves mass exactly and momentum to rounding") {
  for (const auto& scheme : schemes()) {
    INFO(fmt::format("{}", fmt::join(scheme, " ")));
    Simulated run(kCollision, scheme);
    const firn::FrameTotals start = run.totals();
    const double scale = start.mass * 3;  // sum of |m v|
    for (int n = 0; n < 30; ++n) {
      run->step(run->stable_dt());
      const firn::FrameTotals now = run.totals();
      REQUIRE(now.mass == start.mass);
      // Rounding of a thousand particles a step, adding like a random walk.
      REQUIRE(distance(now.momentum, start.momentum) < 1e-13 * scale);
    }
  }
}

TEST_CASE("in float, momentum stays within float's rounding") {
  Simulated run(kCollision, {"simulation.precision=float"});
  const firn::FrameTotals start = run.totals();
  for (int n = 0; n < 60; ++n) run->step(run->stable_dt());
  const firn::FrameTotals now = run.totals();
  CHECK(now.mass == start.mass);
  CHECK(distance(now.momentum, start.momentum) < 1e-6 * start.mass * 3);
}

TEST_CASE("APIC conserves angular momentum through contact and breaking") {
  for (const auto& scheme : schemes({"apic", "mls"})) {
    INFO(fmt::format("{}", fmt::join(scheme, " ")));
    Simulated run(kCollision, scheme);
    const firn::FrameTotals start = run.totals();
    for (int n = 0; n < 60; ++n) run->step(run->stable_dt());
    CHECK(distance(run.totals().angular, start.angular) < 1e-12 * start.mass * 3);
    CHECK(size(start.angular) > 1);
  }
}

TEST_CASE("total energy never grows when nothing acts from outside") {
  // Transfers dissipate and the return map dissipates; the sum with what the return map took may only fall.
  for (const std::string transfer : {"pic", "apic", "mls"}) {
    INFO(transfer);
    Simulated run(kCollision, {"simulation.transfer=" + transfer});
    const firn::FrameTotals start = run.totals();
    const double before = start.kinetic + start.elastic;
    for (int n = 0; n < 100; ++n) run->step(run->stable_dt());
    const firn::FrameTotals now = run.totals();
    CHECK(now.dissipated > 0);
    CHECK(now.kinetic + now.elastic + now.dissipated < before * (1 + 1e-9));
    CHECK(now.kinetic + now.elastic < before);
  }
}

TEST_CASE("free fall is exact: v = -g t, x = x0 - g t (t + dt) / 2, F = I") {
  for (const auto& scheme : schemes()) {
    INFO(fmt::format("{}", fmt::join(scheme, " ")));
    std::vector<std::string> overrides = scheme;
    overrides.insert(overrides.end(), {"bodies.left.velocity=[0,0,0]", "bodies.right.velocity=[0,0,0]",
                                       "bodies.right.angular_velocity=[0,0,0]"});
    Simulated run(
        with(kCollision, "[materials.snow]", "[gravity]\nacceleration = [0, -10, 0]\n[materials.snow]"),
        overrides);
    const firn::FrameTotals start = run.totals();
    const double dt = 1e-3;
    for (int n = 1; n <= 80; ++n) run->step(dt);
    const double t = 80 * dt;
    const firn::FrameTotals now = run.totals();
    CHECK(std::abs(now.momentum[1] / now.mass + 10 * t) < 1e-12);
    CHECK(std::abs((now.gravity - start.gravity) / (10 * now.mass) + 10 * t * (t + dt) / 2) < 1e-12);
    CHECK(std::abs(now.min_J - 1) < 1e-12);
    CHECK(std::abs(now.max_J - 1) < 1e-12);
    // psi is a difference of terms of the size of the modulus: rounding times 1e5 Pa, against 600 J/m^3.
    CHECK(std::abs(now.elastic) < 1e-12 * now.kinetic);
  }
}

TEST_CASE("a spinning disk keeps its angular momentum with APIC, and loses it with PIC") {
  const std::string disk = R"(
[simulation]
dimension = 2
cell_size = 0.05
duration = 2
precision = "double"
[materials.m]
model = "neo_hookean"
density = 1
youngs_modulus = 10
poissons_ratio = 0.3
[[bodies]]
name = "disk"
material = "m"
particles_per_cell = 4
shape = { type = "sphere", center = [0.01, 0.02, 0], radius = 0.25 }
angular_velocity = [0, 0, 57.29577951308232]
)";
  const auto spin_left = [&](std::vector<std::string> overrides) {
    Simulated run(disk, std::move(overrides));
    const double start = run.totals().angular[2];
    for (int n = 0; n < 2000; ++n) run->step(1e-3);
    return run.totals().angular[2] / start;
  };
  CHECK(std::abs(spin_left({"simulation.transfer=apic"}) - 1) < 1e-12);
  // An independent program measured, for particles on a regular lattice: FLIP keeps 0.976, PIC nothing after
  // half a second. Jittered particles lose more of what FLIP cannot see; a blend with PIC would lose nearly
  // all.
  CHECK(spin_left({"simulation.transfer=flip", "simulation.flip_ratio=1"}) == Approx(0.96).margin(0.03));
  CHECK(std::abs(spin_left({"simulation.transfer=pic"})) < 0.01);
}

TEST_CASE("a scene moved by a whole number of cells moves the same way") {
  // From a point file, so that both start from the same particles; seeding jitters by place.
  const auto folder = std::filesystem::temp_directory_path() / "firn_moved_scene";
  std::filesystem::create_directories(folder);
  const auto scene = [&](const std::string& name, double dx, double dy) {
    const auto file = folder / (name + ".csv");
    std::ofstream csv(file);
    csv.precision(17);
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 12; ++j)
        csv << dx + 0.05 * i + 0.013 * std::sin(5 * j) << ',' << dy + 0.05 * j + 0.011 * std::sin(3 * i)
            << ",0," << 3 - 0.4 * i << ',' << 0.2 * j << ",0\n";
    return "[simulation]\ndimension = 2\ncell_size = 0.1\nduration = 1\nprecision = \"double\"\n"
           "[materials.snow]\nmodel = \"snow_stomakhin_2013\"\n"
           "[[bodies]]\nname = \"all\"\nmaterial = \"snow\"\nparticles_per_cell = 4\npoints = \"" +
           name + ".csv\"\n";
  };
  Simulated here(scene("here", 0, 0), {}, folder), there(scene("there", 1.2, -3.4), {}, folder);
  const firn::FrameTotals start = here.totals();
  for (int n = 0; n < 60; ++n) {
    const double dt = here->stable_dt();
    here->step(dt);
    there->step(dt);
  }
  const firn::FrameTotals a = here.totals(), b = there.totals();
  CHECK(a.elastic == Approx(b.elastic).epsilon(1e-9));
  CHECK(a.kinetic == Approx(b.kinetic).epsilon(1e-9));
  CHECK(a.dissipated == Approx(b.dissipated).epsilon(1e-9));
  CHECK(a.kinetic < start.kinetic);
  std::filesystem::remove_all(folder);
}
