#include "engine/scene/overrides.h"

#include <catch2/catch.hpp>

#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {
namespace {

const std::string kTwoBodies = kSmallest + R"(
[[bodies]]
name = "cube"
material = "snow"
shape = { type = "box", min = [0, 0, 0], max = [1, 1, 1] }
)";

TEST_CASE("an override replaces a value, and the last one of a key counts") {
  CHECK(read(kSmallest, {"simulation.cfl=0.2"}).simulation.cfl == 0.2);
  CHECK(read(kSmallest, {"simulation.cfl=0.2", "simulation.cfl = 0.3"}).simulation.cfl == 0.3);
  CHECK(read(kSmallest, {"simulation.cell_size=1e-2"}).simulation.cell_size == 0.01);
}

TEST_CASE("a scene is kept as it was run: read again, it gives the same values") {
  const auto d = read(kTwoBodies, {"simulation.cfl=0.2", "bodies.cube.velocity=[1, 2, 3]",
                                   "gravity.acceleration=[0, -2, 0]"});
  const auto again = read(d.as_run);
  CHECK(again.simulation.cfl == 0.2);
  CHECK(again.bodies.at(1).velocity == VectorQuantity{{{1, {}}, {2, {}}, {3, {}}}});
  CHECK(again.gravity == Vec3(0, -2, 0));
  CHECK(again.as_run == d.as_run);
}

TEST_CASE("a bare word is a string") {
  CHECK(read(kSmallest, {"simulation.transfer=flip"}).simulation.transfer == Transfer::flip);
  CHECK(read(kSmallest, {"simulation.transfer = flip"}).simulation.transfer == Transfer::flip);
  CHECK(read(kSmallest, {"simulation.transfer=\"flip\""}).simulation.transfer == Transfer::flip);
  CHECK(read(kSmallest, {"title=A ball \"of\" snow = 1"}).title == "A ball \"of\" snow = 1");
  CHECK(read(kSmallest, {"title="}).title.empty());
}

TEST_CASE("an override without a value takes the key away") {
  CHECK_FALSE(read(kSmallest, {"gravity={acceleration=[0, 1, 0]}", "gravity="}).gravity);
  CHECK_FALSE(read(kSmallest, {"gravity="}).gravity);
  CHECK_FALSE(read(kSmallest, {"simulation.max_dt=1", "simulation.max_dt = "}).simulation.max_dt);
  CHECK(read(kTwoBodies, {"bodies.cube="}).bodies.size() == 1);
}

TEST_CASE("an override makes keys and sections that the scene does not have") {
  CHECK(read(kSmallest, {"gravity.acceleration=[0, -9.81, 0]"}).gravity == Vec3(0, -9.81, 0));
  CHECK(read(kSmallest, {"gravity={acceleration=[0, 1, 0]}"}).gravity == Vec3(0, 1, 0));
  const auto d = read(kSmallest, {"domain.min=[0,0,0]", "domain.max=[9,9,9]", "domain.contact=slip"});
  REQUIRE(d.domain);
  CHECK(d.domain->max == Vec3(9, 9, 9));
  CHECK(d.domain->contact == Contact::slip);
  CHECK(read(kSmallest, {"output.attributes=[\"Jp\"]"}).output.attributes.at(0).text == "Jp");
}

TEST_CASE("tables in an array go by their index or by their name, elements by their index") {
  CHECK(read(kTwoBodies, {"bodies.0.velocity=[1,2,3]"}).bodies[0].velocity ==
        VectorQuantity{{{1, {}}, {2, {}}, {3, {}}}});
  CHECK(read(kTwoBodies, {"bodies.cube.velocity=[1,2,3]"}).bodies[1].velocity ==
        VectorQuantity{{{1, {}}, {2, {}}, {3, {}}}});
  CHECK(read(kTwoBodies, {"bodies.\"cube\".velocity=[1,2,3]"}).bodies[1].velocity ==
        VectorQuantity{{{1, {}}, {2, {}}, {3, {}}}});
  const auto box = *read(kTwoBodies, {"bodies.cube.shape.max.1=7"}).bodies[1].shape;
  CHECK(std::get<BoxDescription>(box.kind).max == Vec3(1, 7, 1));
  CHECK(read(kTwoBodies, {"materials.snow.density=123"}).materials[0].parameters.contains("density"));
}

TEST_CASE("a table given as a value replaces the old one as a whole") {
  const auto d = read(kTwoBodies, {"bodies.cube.shape={type=\"sphere\", center=[0,0,0], radius=2}"});
  CHECK(std::get<SphereDescription>(d.bodies[1].shape->kind).radius == 2);
}

TEST_CASE("what is wrong with an override is said with the override in the place of a line") {
  const auto check = [](const std::string& override_text, const std::string& message) {
    CHECK(error_in(kTwoBodies, {override_text}) == message);
  };
  check("simulation.cfl=2",
        "--set simulation.cfl=2: simulation.cfl: found the integer 2; allowed: a number in (0, 1]");
  check("simulation.cfl=fast",
        "--set simulation.cfl=fast: simulation.cfl: found the string 'fast'; allowed: a number in (0, 1]");
  check("simulation.clf=0.1",
        "--set simulation.clf=0.1: simulation.clf: unknown key 'clf'; did you mean 'cfl'? known: dimension, "
        "cell_size, "
        "duration, frame_rate, kernel, transfer, flip_ratio, stress_order, precision, path, cfl, max_dt, "
        "mass_cutoff, seed");
  check("bodies.sphere.velocity=[0,0,0]",
        "--set bodies.sphere.velocity=[0,0,0]: bodies.sphere: found no element 'sphere'; there are 2: ball, "
        "cube");
  check("bodies.2.velocity=[0,0,0]",
        "--set bodies.2.velocity=[0,0,0]: bodies.2: found no element '2'; there are 2: ball, cube");
  check("bodies.0.velocity=[0,nan,0]",
        "--set bodies.0.velocity=[0,nan,0]: bodies[0].velocity[1]: found the number nan; allowed: any number "
        "(m/s) or a formula in quotes, of x, y, z");
  check("domain.min=[0,0,0]",
        "--set domain.min=[0,0,0]: domain.max: missing; required: [x, y, z], three numbers (m)");
  check("title.x=1", "--set title.x=1: title: found a table; allowed: a text in quotes");
  check("simulation", "--set simulation: found no KEY=VALUE on one line; allowed: as in simulation.cfl=0.2");
  check("title=a\nx=1",
        "--set title=a\\x0ax=1: found no KEY=VALUE on one line; allowed: as in simulation.cfl=0.2");
  check(
      "a..b=1",
      "--set a..b=1: not valid TOML: Error while parsing key: expected bare key starting character or string "
      "delimiter, saw '.'");
}

TEST_CASE("mistakes in overrides and in the scene are reported together") {
  const std::string error = error_in(kSmallest + "speed = 1\n", {"simulation.cfl=2", "simulation.seed=-1"});
  CHECK(error.find("--set simulation.cfl=2: ") != std::string::npos);
  CHECK(error.find("--set simulation.seed=-1: ") != std::string::npos);
  CHECK(error.find("a.toml:12:1: bodies[0].speed: ") != std::string::npos);
}

TEST_CASE("a deep override is refused like a deep scene") {
  std::string deep = "a";
  for (int i = 0; i < 50'000; ++i) deep += ".a";
  CHECK(error_in(kSmallest, {deep + "=1"}).find("found a key of more than 16 parts") != std::string::npos);
  CHECK(error_in(kSmallest, {"title=" + std::string(100'000, '[')}).empty());  // a bare word, if an odd one
}

}  // namespace
}  // namespace firn::test
