// A disk that turns freely, on a lattice of four points a cell: how much of its angular momentum each
// transfer and kernel keeps. R = 0.25, h = 0.05, one radian a second for two seconds.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/simulated.h"
#include "tests/validation/lattice_disk.h"

using namespace firn;
using firn::test::Simulated;

namespace {

/// What is left of the angular momentum.
double spin(const std::string& kernel, const std::string& transfer, const std::string& order = "usl") {
  const std::string scene = fmt::format(R"(
[simulation]
dimension = 2
cell_size = 0.05
duration = 100
precision = "double"
path = "plain"
kernel = "{}"
transfer = "{}"
stress_order = "{}"
[materials.m]
model = "neo_hookean"
density = 1
youngs_modulus = 10
poissons_ratio = 0.3
[[bodies]]
name = "disk"
material = "m"
shape = {{ type = "sphere", center = [0, 0, 0], radius = 1 }}
)",
                                        kernel, transfer, order);
  std::vector<std::string> overrides;
  if (transfer == "flip") overrides = {"simulation.flip_ratio=1"};
  Simulated s(scene, overrides, FIRN_TEST_DATA, [&](std::vector<Seeds>& seeds) {
    const auto turn = [](const Vec3& x) { return Vec3(-x.y(), x.x(), 0); };
    seeds = {test::lattice_disk(Vec3::Zero(), 0.25, 0.025, turn)};
  });
  const double start = s.totals().angular[2];
  for (int n = 0; n < 2000; ++n) s->step(1e-3);
  return s.totals().angular[2] / start;
}

}  // namespace

TEST_CASE(
    "spin: APIC and MLS keep angular momentum with either B-spline, in every order; PIC keeps nothing") {
  for (const std::string kernel : {"quadratic", "cubic"}) {
    for (const std::string transfer : {"apic", "mls"})
      for (const std::string order : {"usl", "usf", "musl"}) {
        CAPTURE(kernel, transfer, order);
        CHECK(std::abs(spin(kernel, transfer, order) - 1) < 1e-12);  // rounding of 2000 steps
      }
    CHECK(std::abs(spin(kernel, "pic")) < 1e-3);
  }
}

TEST_CASE("spin: FLIP loses some percent, with narrow kernels less") {
  // An independent program found 2.4, 1.9 and 1.8 % for quadratic, GIMP and linear, with a material not
  // recorded.
  const double quadratic = spin("quadratic", "flip"), gimp = spin("gimp", "flip");
  const double linear = spin("linear", "flip");
  CHECK(quadratic > 0.95);
  CHECK(gimp > quadratic);
  CHECK(linear > quadratic);
  CHECK(linear < 0.99);
}
