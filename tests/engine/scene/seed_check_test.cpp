#include "engine/scene/seed_check.h"

#include <catch2/catch.hpp>

#include "engine/scene/reader.h"

using namespace firn;

TEST_CASE("particles that start inside a collider or outside the domain are counted and named") {
  const Plan plan = make_plan(read_scene_text(R"(
[simulation]
dimension = 2
cell_size = 0.1
duration = 1
[materials.rubber]
model = "neo_hookean"
density = 1000
youngs_modulus = 1e4
poissons_ratio = 0.3
[[bodies]]
name = "block"
material = "rubber"
shape = { type = "box", min = [0, 0, 0], max = [1, 1, 0] }
[[colliders]]
name = "ground"
shape = { type = "plane", point = [0, 0, 0], normal = [0, 1, 0] }
keyframes = [ { time = 0, position = [0, 0.5, 0] } ]
[[colliders]]
name = "far"
shape = { type = "sphere", center = [5, 5, 0], radius = 1 }
[domain]
min = [-1, -1, 0]
max = [0.9, 2, 0]
)",
                                              FIRN_TEST_DATA "/scene.toml"));
  Seeds seeds;
  seeds.position = {Vec3(0.1, 0.2, 0), Vec3(0.1, 0.7, 0), Vec3(0.95, 0.7, 0), Vec3(0.2, 0.1, 0)};
  const auto warnings = check_seeds(plan, {&seeds, 1});
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[0] == "body 'block' starts with 2 of its 4 particles (50 %) inside collider 'ground'");
  CHECK(warnings[1] == "body 'block' starts with 1 of its 4 particles (25 %) outside the domain");
}
