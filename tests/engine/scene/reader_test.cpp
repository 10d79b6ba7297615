#include "engine/scene/reader.h"

#include <limits>

#include <catch2/catch.hpp>

#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {
namespace {

TEST_CASE("a scene with only what is required has every other value at its default") {
  const SceneDescription d = read(kSmallest);
  CHECK(d.file == "a.toml");
  CHECK(d.title.empty());
  CHECK(d.simulation.dimension == 3);
  CHECK(d.simulation.cell_size == 0.1);
  CHECK(d.simulation.duration == 1);
  CHECK(d.simulation.frame_rate == 24);
  CHECK(d.simulation.transfer == Transfer::apic);
  CHECK(d.simulation.precision == Precision::single);
  CHECK(d.simulation.cfl == 0.4);
  CHECK(d.simulation.seed == 1);
  CHECK_FALSE(d.simulation.flip_ratio);
  CHECK_FALSE(d.simulation.max_dt);
  CHECK_FALSE(d.gravity);
  CHECK_FALSE(d.domain);
  CHECK(d.colliders.empty());
  CHECK(d.output.attributes.empty());

  REQUIRE(d.materials.size() == 1);
  CHECK(d.materials[0].name == "snow");
  CHECK(d.materials[0].model.text == "snow_stomakhin_2013");
  CHECK(d.materials[0].parameters.empty());

  REQUIRE(d.bodies.size() == 1);
  const BodyDescription& ball = d.bodies[0];
  CHECK(ball.name == "ball");
  CHECK(ball.material.text == "snow");
  CHECK(ball.sampling == Sampling::jittered);
  CHECK(ball.particles_per_cell == 8);
  CHECK(ball.velocity == VectorQuantity{});
  CHECK_FALSE(ball.points);
  REQUIRE(ball.shape);
  const auto& sphere = std::get<SphereDescription>(ball.shape->kind);
  CHECK(sphere.center == Vec3(1, 2, 3));
  CHECK(sphere.radius == 0.5);
}

TEST_CASE("names and shapes keep the place they were written at") {
  const SceneDescription d = read(kSmallest);
  const auto at = [](const SourceMark& mark) { return std::tuple(mark.file, mark.line, mark.column); };
  CHECK(at(d.materials[0].mark) == std::tuple("a.toml", 5, 1));
  CHECK(at(d.materials[0].model.mark) == std::tuple("a.toml", 6, 9));
  CHECK(at(d.bodies[0].mark) == std::tuple("a.toml", 8, 1));
  CHECK(at(d.bodies[0].material.mark) == std::tuple("a.toml", 10, 12));
  CHECK(at(d.bodies[0].shape->mark) == std::tuple("a.toml", 11, 9));
}

TEST_CASE("every key of every section arrives at its member") {
  const SceneDescription d = read_scene(FIRN_TEST_DATA "/scenes/every_key.toml");
  CHECK(d.title == "title");
  CHECK(d.description == "description");
  CHECK(d.simulation.dimension == 3);
  CHECK(d.simulation.cell_size == 0.25);
  CHECK(d.simulation.duration == 2.5);
  CHECK(d.simulation.frame_rate == 30);
  CHECK(d.simulation.kernel == KernelName::gimp);
  CHECK(d.simulation.transfer == Transfer::flip);
  CHECK(d.simulation.flip_ratio == 0.95);
  CHECK(d.simulation.stress_order == StressOrder::musl);
  CHECK(d.simulation.precision == Precision::double_);
  CHECK(d.simulation.cfl == 0.25);
  CHECK(d.simulation.max_dt == 1e-3);
  CHECK(d.simulation.mass_cutoff == 1e-5);
  CHECK(d.simulation.seed == 77);
  CHECK(d.gravity == Vec3(1, 2, 3));
  REQUIRE(d.body_force);
  CHECK(d.body_force->acceleration == VectorQuantity{{{0, "sin(t)"}, {}, {0, "X + y"}}});
  REQUIRE(d.materials.size() == 2);
  CHECK(d.materials[0].name == "wet");  // in the order of the file
  CHECK(d.materials[1].name == "dry");
  CHECK(std::get<double>(d.materials[0].parameters.at("density").value) == 500);
  CHECK(std::get<double>(d.materials[0].parameters.at("hardening_cap").value) ==
        std::numeric_limits<double>::infinity());
  CHECK(d.materials[0].parameters.at("density").mark.line == 27);

  REQUIRE(d.bodies.size() == 4);
  CHECK(d.bodies[0].sampling == Sampling::poisson);
  CHECK(d.bodies[0].particles_per_cell == 4.5);
  CHECK(d.bodies[0].velocity == VectorQuantity{{{1, {}}, {0, "-2 * z"}, {3, {}}}});
  CHECK(d.bodies[0].angular_velocity == Vec3(10, 20, 30));
  CHECK(d.bodies[1].points->text == "grains.csv");
  CHECK_FALSE(d.bodies[1].shape);

  REQUIRE(d.colliders.size() == 2);
  CHECK(d.colliders[0].name == "ground");
  CHECK(d.colliders[0].contact == Contact::slip);
  CHECK(d.colliders[0].friction == 0.25);
  CHECK(d.colliders[1].contact == Contact::sticky);
  REQUIRE(d.colliders[1].keyframes.size() == 2);
  CHECK(d.colliders[1].keyframes[0].time == 0);
  CHECK(d.colliders[1].keyframes[0].rotation == Vec3::Zero());
  CHECK(d.colliders[1].keyframes[1].time == 1.5);
  CHECK(d.colliders[1].keyframes[1].position == Vec3(0, 0, 2));
  CHECK(d.colliders[1].keyframes[1].rotation == Vec3(0, 90, 0));

  REQUIRE(d.loads.size() == 1);
  CHECK(d.loads[0].name == "press");
  CHECK(std::get<BoxDescription>(d.loads[0].region.kind).max == Vec3(1, 1, 1));
  CHECK(d.loads[0].force == VectorQuantity{{{}, {0, "-10 * min(t, 1)"}, {}}});

  REQUIRE(d.domain);
  CHECK(d.domain->min == Vec3(-1, -2, -3));
  CHECK(d.domain->max == Vec3(1, 2, 3));
  CHECK(d.domain->contact == Contact::separating);
  CHECK(d.domain->friction == 0.5);
  REQUIRE(d.output.attributes.size() == 2);
  CHECK(d.output.attributes[0].text == "F_E");
  CHECK(d.output.attributes[1].text == "Jp");
  CHECK(d.output.attributes[1].mark.line == 97);
}

TEST_CASE("every type of shape arrives with its numbers") {
  const SceneDescription d = read_scene(FIRN_TEST_DATA "/scenes/every_key.toml");
  const ShapeDescription& shape = *d.bodies[0].shape;
  CHECK(shape.scale == 2);
  CHECK(shape.rotate == Vec3(0, 0, 90));
  CHECK(shape.translate == Vec3(5, 6, 7));
  const auto& difference = std::get<CombinationDescription>(shape.kind);
  CHECK(difference.operation == CombinationDescription::Operation::subtract);
  REQUIRE(difference.operands.size() == 3);

  const auto& unite = std::get<CombinationDescription>(difference.operands[0].kind);
  CHECK(unite.operation == CombinationDescription::Operation::unite);
  const auto& box = std::get<BoxDescription>(unite.operands.at(0).kind);
  CHECK(box.min == Vec3(0, 0, 0));
  CHECK(box.max == Vec3(1, 2, 3));
  const auto& mesh = std::get<MeshDescription>(unite.operands.at(1).kind);
  CHECK(mesh.file.text == "meshes/rock.obj");

  const auto& intersect = std::get<CombinationDescription>(difference.operands[1].kind);
  CHECK(intersect.operation == CombinationDescription::Operation::intersect);
  const auto& cylinder = std::get<CylinderDescription>(intersect.operands.at(0).kind);
  CHECK(cylinder.start == Vec3(0, 0, 0));
  CHECK(cylinder.end == Vec3(0, 1, 0));
  CHECK(cylinder.radius == 0.5);
  const auto& cone = std::get<ConeDescription>(intersect.operands.at(1).kind);
  CHECK(cone.base == Vec3(0, 0, 0));
  CHECK(cone.apex == Vec3(0, 2, 0));
  CHECK(cone.radius == 0.75);

  const auto& plane = std::get<PlaneDescription>(difference.operands[2].kind);
  CHECK(plane.point == Vec3(0, 1, 0));
  CHECK(plane.normal == Vec3(0, 3, 0));
  const auto& level_set = std::get<LevelSetDescription>(d.bodies[2].shape->kind);
  CHECK(level_set.file.text == "drift.vdb");
  CHECK(level_set.grid == "surface");
  CHECK(level_set.threshold == 0.25);
  const auto& image = std::get<ImageDescription>(d.bodies[3].shape->kind);
  CHECK(image.file.text == "foam.##.png");
  CHECK(image.size == Vec3(1, 2, 3));
  CHECK(image.threshold == 0.75);
  CHECK(image.solid == SolidPixels::dark);
}

TEST_CASE("a scene in the plane turns about z alone and takes no third coordinate") {
  const std::string text = kSmallest + "angular_velocity = [0, 0, 5]\n";
  std::string plane = text;
  plane.replace(plane.find("[1, 2, 3]"), 9, "[1, 2, 0]");
  CHECK(read(plane, {"simulation.dimension=2"}).bodies[0].angular_velocity == Vec3(0, 0, 5));
  CHECK(error_in(text, {"simulation.dimension=2"}).find("shape.center[2]: found the integer 3; allowed: 0") !=
        std::string::npos);
  CHECK(error_in(text, {"simulation.dimension=1"})
            .find("angular_velocity[2]: found the integer 5; allowed: 0") != std::string::npos);
}

TEST_CASE("a byte order mark and Windows line ends change nothing") {
  std::string windows = "\xef\xbb\xbf";
  for (char c : kSmallest) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  CHECK(read(windows).bodies[0].name == "ball");
}

}  // namespace
}  // namespace firn::test
