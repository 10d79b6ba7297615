// The vectorised path against the plain one: the same scene, the same steps, the same particles.
#include "materials/model_info.h"
#include "tests/engine/simulation/vector_scene.h"

using namespace firn;
using namespace firn::test;

namespace {

/// So many steps on both paths; then the totals are apart by `scale` of themselves at most.
void compare_paths(const std::string& isa, const std::string& scene, const std::vector<std::string>& common,
                   int steps, double scale) {
  auto automatic = common, on_plain = common;
  on_plain.push_back("simulation.path=\"plain\"");
  const auto fast = on_isa(isa, scene, automatic);
  if (!fast) return;
  Simulated plain(scene, on_plain);
  REQUIRE_FALSE(plain.plan.path.isa);
  REQUIRE((*fast)->stable_dt() == Approx(plain->stable_dt()).epsilon(scale > 1e-6 ? 1e-5 : 1e-12));
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
  CHECK(b.kinetic == Approx(a.kinetic).epsilon(scale));
  CHECK(b.elastic == Approx(a.elastic).epsilon(100 * scale));
  CHECK(b.dissipated == Approx(a.dissipated).epsilon(100 * scale));
  for (int d = 0; d < 3; ++d)
    CHECK(b.momentum[d] == Approx(a.momentum[d]).epsilon(scale).margin(scale * a.mass));
  CHECK(most(fast->attribute("P"), plain.attribute("P")) < scale + 1e-6);
}

}  // namespace

TEST_CASE("the vectorised path takes the steps of the plain one") {
  const std::string precision = GENERATE("double", "float");
  const std::string transfer = GENERATE("mls", "apic", "pic");
  const int dimension = GENERATE(2, 3);
  const std::string isa = GENERATE("avx512", "avx2", "sse4");
  CAPTURE(precision, transfer, dimension, isa);
  const int steps = 40;
  compare_paths(isa, collision_scene(dimension), settings(precision, transfer, dimension, "automatic"), steps,
                steps * (precision == "double" ? 1e-12 : 3e-7));
}

TEST_CASE("the vectorised path has every model as the plain one has it") {
  const ModelInfo& model = models()[static_cast<std::size_t>(GENERATE(range(0, kModels)))];
  const std::string precision = GENERATE("double", "float");
  const int dimension = GENERATE(2, 3);
  CAPTURE(model.name, precision, dimension);
  const int steps = 16;
  compare_paths("avx512", with_material(collision_scene(dimension), model),
                settings(precision, "mls", dimension, "automatic"), steps,
                steps * (precision == "double" ? 1e-12 : 3e-7));
}
