#include "engine/output/diagnostics.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "engine/output/json_file.h"
#include "tests/engine/output/temporary_folder.h"

namespace firn {

using testing::read_file;
using testing::TemporaryFolder;

TEST_CASE("diagnostics are one row a frame in full precision") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "diagnostics.csv";
  Diagnostics diagnostics(file, {"dt_cuts", "J_clamps"});
  FrameView frame;
  diagnostics.append(frame);
  frame.frame = 2;
  frame.time = 1.0 / 24;
  frame.particles = 1000;
  frame.steps = {42, 1e-5, 0.1};
  frame.totals = {.mass = 0.3,
                  .momentum = {1, 2, 3},
                  .angular = {-4, 5, 6e-20},
                  .kinetic = 7,
                  .elastic = 0.5,
                  .gravity = -2.25,
                  .dissipated = 0.125,
                  .max_speed = 9,
                  .min_J = 0.97,
                  .max_J = 1.01};
  frame.counters = {{"J_clamps", 3}};
  diagnostics.append(frame);
  CHECK(read_file(file) ==
        "frame,time,steps,dt_min,dt_max,particles,mass,momentum_x,momentum_y,momentum_z,angular_x,angular_y,"
        "angular_z,"
        "kinetic,elastic,gravity,dissipated,total,max_speed,min_J,max_J,dt_cuts,J_clamps\n"
        "1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1,1,0,0\n"
        "2,0.041666666666666664,42,1e-05,0.1,1000,0.3,1,2,3,-4,5,6e-20,7,0.5,-2.25,0.125,5.375,9,0.97,1.01,0,"
        "3\n");
}

TEST_CASE("diagnostics without counters end at max_J") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "diagnostics.csv";
  const Diagnostics diagnostics(file, {});
  const std::string text = read_file(file);
  CHECK(text.substr(text.rfind(',')) == ",max_J\n");
}

TEST_CASE("a JSON file is whole and survives a name that is not UTF-8") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "run.json";
  write_json(file, {{"frames", 3}, {"scene", "a\xff.toml"}});
  const auto back = nlohmann::json::parse(read_file(file));
  CHECK(back["frames"] == 3);
  CHECK(testing::names_in(folder.path()) == std::vector<std::string>{"run.json"});
}

}  // namespace firn
