#include "engine/scene/plan.h"

#include <catch2/catch.hpp>

#include "engine/scene/estimate.h"
#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {

TEST_CASE("a scene shorter than a frame is planned, with a warning that only its start is written") {
  const Plan plan = make_plan(read(kSmallest, {"simulation.duration=0.01", "simulation.frame_rate=24"}));
  CHECK(plan.frames() == 1);
  REQUIRE(plan.warnings.size() == 1);
  CHECK_THAT(plan.warnings[0], Catch::StartsWith("simulation.duration (0.01 s) is shorter than a frame"));
  CHECK(make_plan(read(kSmallest, {"simulation.duration=1"})).warnings.empty());
}

TEST_CASE("each attribute asked for takes memory in two snapshots and in the frame being encoded") {
  const Estimate none = estimate(make_plan(read(kSmallest)));
  const Estimate some = estimate(make_plan(read(std::string(kSmallest) + R"(
[output]
attributes = ["F_E", "Jp"]
)")));
  CHECK(some.particle_bytes == none.particle_bytes);
  CHECK(some.peak_bytes - none.peak_bytes == Approx(3 * 4 * (9 + 1) * none.total_particles));
}

}  // namespace firn::test
