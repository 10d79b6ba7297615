// Tiles of 16 particles know nothing of blocks and materials: the vectorised path must get them right where
// a block begins or ends in the middle of one, and where two materials share the block.
#include <random>

#include "tests/engine/simulation/vector_scene.h"

using namespace firn;
using namespace firn::test;

namespace {

constexpr double kCell = 8;  // particles of many tons: no momentum may pass for a velocity

const std::string kScene = R"(
[simulation]
cell_size = 8
duration = 100
[materials.snow]
model = "snow_stomakhin_2013"
[materials.rubber]
model = "neo_hookean"
density = 300
youngs_modulus = 2e5
poissons_ratio = 0.3
[[bodies]]
name = "snow"
material = "snow"
shape = { type = "sphere", center = [0, 0, 0], radius = 20 }
[[bodies]]
name = "rubber"
material = "rubber"
shape = { type = "sphere", center = [0, 0, 0], radius = 20 }
[output]
attributes = ["F_E", "stress", "Jp"]
)";

/// A row of blocks with these many particles of the one and of the other material.
constexpr int kCounts[][2] = {{1, 0},   {0, 1},   {15, 16}, {16, 15}, {0, 17}, {17, 0}, {31, 1},
                              {33, 47}, {16, 16}, {3, 3},   {64, 2},  {0, 5},  {5, 0},  {100, 37}};

void place(std::vector<Seeds>& seeds, int dimension) {
  std::mt19937 random(25);
  std::uniform_real_distribution<double> cell(0.5, 4.5), speed(-20, 20);
  const auto vector = [&](auto& values) {
    Vec3 out = Vec3::Zero();
    for (int d = 0; d < dimension; ++d) out[d] = values(random);
    return out;
  };
  for (int k = 0; k < 2; ++k) {
    Seeds& body = seeds[static_cast<std::size_t>(k)];
    body = {};
    int block = -6;
    for (const auto& counts : kCounts) {
      for (int n = 0; n < counts[k]; ++n) {
        body.position.push_back(kCell * (vector(cell) + Vec3(4 * block, 0, 0)));
        body.velocity.push_back(vector(speed));
      }
      ++block;
    }
    body.volume = static_cast<double>(body.position.size()) * std::pow(kCell / 2, dimension);
  }
}

}  // namespace

TEST_CASE("tiles shared by blocks and blocks shared by materials change nothing") {
  const int dimension = GENERATE(2, 3);
  const std::string transfer = GENERATE("mls", "apic", "pic"), isa = GENERATE("avx512", "avx2", "sse4");
  const std::string precision = GENERATE("double", "float");
  CAPTURE(dimension, transfer, isa, precision);
  const auto put = [&](std::vector<Seeds>& seeds) { place(seeds, dimension); };
  const auto fast = on_isa(isa, kScene, settings(precision, transfer, dimension, "automatic"), put);
  if (!fast) return;
  Simulated plain(kScene, settings(precision, transfer, dimension, "plain"), FIRN_TEST_DATA, put);
  const double dt = 0.5 * plain->stable_dt();
  for (int n = 1; n <= 24; ++n) {
    plain->step(dt);
    (*fast)->step(dt, n % 8 == 0 ? 0 : dt);
    // Nothing but particles is asked for its speed and stiffness.
    REQUIRE((*fast)->stable_dt() == Approx(plain->stable_dt()).epsilon(precision == "double" ? 1e-9 : 1e-3));
  }
  REQUIRE((*fast)->sorts() > 1);
  // Attributes are floats, of numbers of size 1 to 4; a float state gathers as much in each step, and its
  // light nodes, of which the velocity is a quotient of small sums, more.
  const double scale = precision == "double" ? 1 : 100;
  CHECK(most(fast->attribute("P"), plain.attribute("P")) < 5e-7 * scale);
  CHECK(most(fast->attribute("v"), plain.attribute("v")) < 1e-6 * scale);
  CHECK(most(fast->attribute("F_E"), plain.attribute("F_E")) < 1e-6 * scale);
  CHECK(most(fast->attribute("Jp"), plain.attribute("Jp")) < 1e-6 * scale);
  const FrameTotals a = plain.totals(), b = fast->totals();
  CHECK(b.mass == Approx(a.mass).epsilon(1e-6));
  CHECK(b.dissipated == Approx(a.dissipated).epsilon(precision == "double" ? 1e-9 : 1e-2));
}
