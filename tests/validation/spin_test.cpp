// A disk that turns freely, on a lattice of four points a cell: how much of its angular momentum each
// transfer and kernel keeps. R = 0.25, h = 0.05, one radian a second for two seconds.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/simulated.h"

using namespace firn;
using firn::test::Simulated;

namespace {

/// What is left of the angular momentum.
double spin(const std::string& kernel, const std::string& transfer, const std::string& order = "usl") {
  constexpr double kRadius = 0.25, kSpacing = 0.025;
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
    Seeds disk;
    for (int i = -10; i < 10; ++i)
      for (int j = -10; j < 10; ++j) {
        const Vec3 x = kSpacing * Vec3(i + 0.5, j + 0.5, 0);
        if (x.norm() > kRadius) continue;
        disk.position.push_back(x);
        disk.velocity.push_back(Vec3(-x.y(), x.x(), 0));
      }
    disk.volume = kSpacing * kSpacing * static_cast<double>(disk.position.size());
    seeds = {disk};
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
