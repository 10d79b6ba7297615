// The vectorised path against the plain one: the same scene, the same steps, the same particles.
#include "tests/engine/simulation/vector_scene.h"

using namespace firn;
using namespace firn::test;

TEST_CASE("the vectorised path takes the steps of the plain one") {
  const std::string precision = GENERATE("double", "float");
  const std::string transfer = GENERATE("mls", "apic", "pic");
  const int dimension = GENERATE(2, 3);
  const std::string isa = GENERATE("avx512", "avx2", "sse4");
  CAPTURE(precision, transfer, dimension, isa);
  const auto fast =
      on_isa(isa, collision_scene(dimension), settings(precision, transfer, dimension, "automatic"));
  if (!fast) return;
  Simulated plain(collision_scene(dimension), settings(precision, transfer, dimension, "plain"));
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
