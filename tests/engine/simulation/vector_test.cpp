// The vectorised path against the plain one: the same scene, the same steps, the same particles.
#include <cstdlib>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/support/simulated.h"

using namespace firn;
using namespace firn::test;

namespace {

// Two bodies of two materials that hit each other, a ground and a moving collider, walls, gravity, spin:
// everything a step can do, in blocks of negative and positive coordinates.
std::string scene(int dimension) {
  std::string text = R"(
[simulation]
cell_size = 0.05
duration = 1
[gravity]
acceleration = [0.5, -9.81, 0]
[materials.snow]
model = "snow_stomakhin_2013"
[materials.rubber]
model = "neo_hookean"
density = 300
youngs_modulus = 2e5
poissons_ratio = 0.3
[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [-0.12, 0.2, 0], radius = 0.19 }
velocity = [3, -5, 0]
angular_velocity = [0, 0, 300]
[[bodies]]
name = "block"
material = "rubber"
shape = { type = "box", min = [0.08, 0.05, 0], max = [0.4, 0.3, 0] }
velocity = [-3, 0, 0]
[[colliders]]
name = "ground"
shape = { type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }
friction = 0.4
[[colliders]]
name = "paddle"
shape = { type = "sphere", center = [0, 0, 0], radius = 0.1 }
contact = "slip"
keyframes = [ { time = 0, position = [-0.4, 0.2, 0] }, { time = 1, position = [3, 0.2, 0] } ]
[domain]
min = [-0.6, -1, 0]
max = [0.6, 1, 0]
[output]
attributes = ["F_E", "stress", "Jp"]
)";
  if (dimension == 3)
    for (const auto& [from, to] :
         {std::pair("center = [-0.12, 0.2, 0]", "center = [-0.12, 0.2, 0.02]"),
          std::pair("[3, -5, 0]", "[3, -5, 0.3]"), std::pair("[0, 0, 300]", "[40, 20, 300]"),
          std::pair("0.05, 0]", "0.05, -0.15]"), std::pair("0.3, 0] }", "0.3, 0.17] }"),
          std::pair("-1, 0]", "-1, -0.4]"), std::pair("1, 0]\n[output", "1, 0.4]\n[output")})
      text.replace(text.find(from), std::string(from).size(), to);
  return text;
}

struct Difference {
  double P = 0, v = 0, F = 0, stress = 0;
};

double most(const std::vector<float>& a, const std::vector<float>& b) {
  double out = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    out = std::max(out, std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k])));
  return out;
}

std::vector<std::string> settings(const std::string& precision, const std::string& transfer, int dimension,
                                  const std::string& path) {
  return {"simulation.precision=\"" + precision + '"', "simulation.transfer=\"" + transfer + '"',
          "simulation.dimension=" + std::to_string(dimension), "simulation.path=\"" + path + '"'};
}

}  // namespace

TEST_CASE("the vectorised path takes the steps of the plain one") {
  const std::string precision = GENERATE("double", "float");
  const std::string transfer = GENERATE("mls", "apic", "pic");
  const int dimension = GENERATE(2, 3);
  const std::string isa = GENERATE("avx512", "avx2", "sse4");
  CAPTURE(precision, transfer, dimension, isa);
  setenv("FIRN_ISA", isa.c_str(), 1);
  std::unique_ptr<Simulated> fast;
  try {
    fast =
        std::make_unique<Simulated>(scene(dimension), settings(precision, transfer, dimension, "automatic"));
  } catch (const Error& error) {
    if (error.code() != ExitCode::environment) throw;
    WARN("no " << isa << " here");  // the other sets are compared
  }
  unsetenv("FIRN_ISA");
  if (!fast) return;
  Simulated plain(scene(dimension), settings(precision, transfer, dimension, "plain"));
  REQUIRE(fast->plan.path.isa);
  REQUIRE_FALSE(plain.plan.path.isa);
  REQUIRE((*fast)->stable_dt() == Approx(plain->stable_dt()).epsilon(precision == "double" ? 1e-12 : 1e-5));
  const int steps = 40;
  double dt = plain->stable_dt();
  for (int n = 0; n < steps; ++n) {
    const double next = n + 1 < steps ? 0.9 * plain->stable_dt() : 0;
    plain->step(dt, next);
    (*fast)->step(dt, next);
    dt = next;
    // Now and then a step turns out to be too long.
    if (next > 0 && n % 7 == 3) (*fast)->shorten(dt = 0.7 * next);
  }
  // Double is compared in the totals, which are not rounded to float as attributes are.
  const FrameTotals a = plain.totals(), b = fast->totals();
  const double scale = precision == "double" ? steps * 1e-12 : steps * 3e-7;
  CHECK(b.kinetic == Approx(a.kinetic).epsilon(scale));
  CHECK(b.elastic == Approx(a.elastic).epsilon(100 * scale));
  CHECK(b.dissipated == Approx(a.dissipated).epsilon(100 * scale));
  for (int d = 0; d < 3; ++d)
    CHECK(b.momentum[d] == Approx(a.momentum[d]).epsilon(scale).margin(scale * a.mass));
  CHECK(most(fast->attribute("P"), plain.attribute("P")) < scale + 1e-6);
}
