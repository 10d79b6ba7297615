// Two steps fused, a step made shorter than announced, and a scene standing elsewhere: on the vectorised
// path these are ways to the same end.
#include "tests/engine/simulation/vector_scene.h"

using namespace firn;
using namespace firn::test;

namespace {

constexpr int kSteps = 60;

/// Steps of `dt`, each announced to the one before as `announced` (0: not at all) and then made dt again.
void play(Simulated& run, double dt, double announced) {
  for (int n = 1; n < kSteps; ++n) {
    run->step(dt, announced);
    if (announced > 0 && announced != dt) run->shorten(dt);
  }
  run->step(dt, 0);
}

void check_agree(Simulated& run, Simulated& expected) {
  const FrameTotals a = expected.totals(), b = run.totals();
  // Sums in another order: a rounding error a step, which contact and breaking spread to whoever is near.
  // The elastic energy is a small difference of large terms.
  const double scale = kSteps * 1e-12;
  CHECK(b.mass == Approx(a.mass).epsilon(1e-14));
  CHECK(b.kinetic == Approx(a.kinetic).epsilon(scale));
  CHECK(b.elastic == Approx(a.elastic).epsilon(100 * scale));
  CHECK(b.dissipated == Approx(a.dissipated).epsilon(100 * scale));
  for (int d = 0; d < 3; ++d)
    CHECK(b.momentum[d] == Approx(a.momentum[d]).epsilon(scale).margin(scale * a.mass));
  // Attributes are floats: two units in the last place of a position below 1 m, of a velocity below 8 m/s.
  CHECK(most(run.attribute("P"), expected.attribute("P")) < 1.2e-7);
  CHECK(most(run.attribute("v"), expected.attribute("v")) < 1e-6);
  CHECK(most(run.attribute("F_E"), expected.attribute("F_E")) < 2.4e-7);
}

}  // namespace

TEST_CASE("fused steps, and steps that turn out shorter or longer than announced, end where single ones do") {
  const std::string transfer = GENERATE("mls", "apic", "pic");
  const int dimension = GENERATE(2, 3);
  CAPTURE(transfer, dimension);
  const auto make = [&] {
    return std::make_unique<Simulated>(collision_scene(dimension, 2e4),
                                       settings("double", transfer, dimension, "automatic"));
  };
  const auto single = make();
  REQUIRE(single->plan.path.isa);
  const double dt = 0.6 * (*single)->stable_dt();
  play(*single, dt, 0);
  REQUIRE((*single)->sorts() > 2);
  CHECK(single->totals().dissipated > 0);
  for (const double announced : {1.0, 0.5, 1.6}) {
    INFO("announced as " << announced << " of its length");
    const auto fused = make();
    play(*fused, dt, announced * dt);
    REQUIRE((*fused)->sorts() > 2);
    check_agree(*fused, *single);
  }
}

TEST_CASE("the vectorised path does not care at which blocks a scene stands") {
  const int dimension = GENERATE(2, 3);
  CAPTURE(dimension);
  // Free of walls and colliders. The cell and the shift are binary fractions: the start is the same exactly.
  std::string scene = collision_scene(dimension, 2e4);
  scene.erase(scene.find("[[colliders]]"), scene.find("[output]") - scene.find("[[colliders]]"));
  auto overrides = settings("double", "apic", dimension, "automatic");
  overrides.push_back("simulation.cell_size=0.0625");
  const Vec3 shift = 4 * 0.0625 * Vec3(5, -7, dimension == 3 ? 3 : 0);
  const auto round = [](Seeds& body) {
    for (Vec3& x : body.position) x = (x * 65536).array().round() / 65536;
  };
  Simulated here(scene, overrides, FIRN_TEST_DATA, [&](auto& seeds) {
    for (Seeds& body : seeds) round(body);
  });
  Simulated there(scene, overrides, FIRN_TEST_DATA, [&](auto& seeds) {
    for (Seeds& body : seeds) {
      round(body);
      for (Vec3& x : body.position) x += shift;
    }
  });
  const double dt = 0.6 * here->stable_dt();
  play(here, dt, dt);
  play(there, dt, dt);
  REQUIRE(here->sorts() > 2);
  const FrameTotals a = here.totals(), b = there.totals();
  // Places are rounded to an eighth of the digits of the shift at most, once a step.
  CHECK(b.kinetic == Approx(a.kinetic).epsilon(kSteps * 1e-12));
  CHECK(b.elastic == Approx(a.elastic).epsilon(kSteps * 1e-10));
  CHECK(b.dissipated == Approx(a.dissipated).epsilon(kSteps * 1e-10));
  CHECK(most(there.attribute("F_E"), here.attribute("F_E")) < 2.4e-7);
}

TEST_CASE("fused steps conserve mass exactly and momentum to rounding") {
  const std::string precision = GENERATE("double", "float");
  const std::string transfer = GENERATE("mls", "apic", "pic");
  const int dimension = GENERATE(2, 3);
  CAPTURE(precision, transfer, dimension);
  std::string scene = collision_scene(dimension, 2e4);
  scene.erase(scene.find("[[colliders]]"), scene.find("[output]") - scene.find("[[colliders]]"));
  scene.erase(scene.find("[gravity]"), scene.find("[materials.snow]") - scene.find("[gravity]"));
  Simulated run(scene, settings(precision, transfer, dimension, "automatic"));
  REQUIRE(run.plan.path.isa);
  const FrameTotals start = run.totals();
  const double dt = 0.6 * run->stable_dt();
  play(run, dt, dt);
  REQUIRE(run->sorts() > 2);
  const FrameTotals end = run.totals();
  CHECK(end.mass == start.mass);
  CHECK(end.kinetic < 0.99 * start.kinetic);  // they did collide
  // Rounding of some thousand particles and nodes a step, adding like a random walk.
  const double rounding = precision == "double" ? 1e-13 : 1e-5;
  for (int d = 0; d < 3; ++d)
    CHECK(std::abs(end.momentum[d] - start.momentum[d]) < rounding * start.mass * 6);
}
