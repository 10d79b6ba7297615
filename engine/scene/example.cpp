#include "engine/scene/example.h"

#include <array>

#include "engine/scene/attributes.h"
#include "engine/scene/toml_writer.h"
#include "materials/model_info.h"

namespace firn {
namespace {

ShapeDescription shape(ShapeDescription::Kind kind) {
  ShapeDescription out;
  out.kind = std::move(kind);
  return out;
}

ShapeDescription combine(CombinationDescription::Operation operation,
                         std::vector<ShapeDescription> operands) {
  return shape(CombinationDescription{operation, std::move(operands)});
}

// What the model cannot do without gets a number that it allows.
double sample(const Parameter& p) {
  if (!p.required()) return p.default_value;
  const double by_unit = p.unit == "Pa" ? 1e6 : p.unit == "kg/m^3" ? 1000 : 0.3;
  return p.allows(by_unit) ? by_unit : (p.min + p.max) / 2;
}

MaterialDescription material(std::string name, const ModelInfo& model) {
  MaterialDescription out;
  out.name = std::move(name);
  out.model.text = model.name;
  for (const Parameter& p : model.parameters) out.parameters[std::string(p.name)].value = sample(p);
  return out;
}

BodyDescription body(std::string name, std::string_view material, ShapeDescription shape) {
  BodyDescription out;
  out.name = std::move(name);
  out.material.text = material;
  out.shape = std::move(shape);
  return out;
}

// A block with a pointed roof and a hole through it.
ShapeDescription hut() {
  using enum CombinationDescription::Operation;
  const auto walls = shape(BoxDescription{{0.7, 0, -0.3}, {1.3, 0.4, 0.3}});
  const auto roof = shape(ConeDescription{{1, 0.4, 0}, {1, 0.8, 0}, 0.4});
  const auto tunnel = shape(CylinderDescription{{0.6, 0.1, 0}, {1.4, 0.1, 0}, 0.15});
  const auto above_ground = shape(PlaneDescription{{0, 0.05, 0}, {0, -1, 0}});
  return combine(subtract, {combine(unite, {walls, roof}), combine(intersect, {tunnel, above_ground})});
}

std::vector<ColliderDescription> colliders() {
  ColliderDescription ground;
  ground.name = "ground";
  ground.shape = shape(PlaneDescription{{0, 0, 0}, {0, 1, 0}});
  ground.friction = 0.3;
  ColliderDescription shovel;
  shovel.name = "shovel";
  shovel.shape = shape(BoxDescription{{-0.05, 0, -0.4}, {0.05, 0.3, 0.4}});
  shovel.contact = Contact::sticky;
  shovel.keyframes = {{0, {-1, 0, 0}, {0, 0, 0}}, {0.5, {-0.7, 0, 0}, {0, 0, -20}}};
  return {ground, shovel};
}

SceneDescription live_scene(const ModelInfo& model) {
  SceneDescription d;
  d.title = "Every key of a scene";
  d.description = "A ball is thrown at a hut of snow. The hut gives way and keeps its dent.";
  d.simulation.cell_size = 0.05;
  d.simulation.duration = 0.5;
  d.gravity = Vec3(0, -9.81, 0);
  d.materials = {material("snow", model)};
  BodyDescription ball = body("ball", "snow", shape(SphereDescription{{0, 0.4, 0}, 0.2}));
  ball.velocity[0].number = 4;
  ball.velocity[1].formula = "1 + 0.5 * sin(2 * pi * z)";
  ball.angular_velocity = {0, 0, -90};
  d.bodies = {ball, body("hut", "snow", hut())};
  d.colliders = colliders();
  d.domain = DomainDescription{{-2, -0.2, -1}, {2, 2, 1}};
  for (const Attribute& attribute : kAttributes)
    if (!attribute.needs || !kMaterialState.has(*attribute.needs) || model.columns.has(*attribute.needs))
      d.output.attributes.push_back({std::string(attribute.name), {}});
  return d;
}

// Text that is not live: each line starts with '#'.
std::string disabled(std::string_view text) {
  std::string out = text.empty() ? "" : "#";
  for (char c : text) {
    out += c;
    if (c == '\n') out += '#';
  }
  out.pop_back();  // the last line ends the text
  return out;
}

std::string other_materials(TomlWriter::Explained& explained, const ModelInfo& shown) {
  std::string out = "\n# The other models, each with a body made of it.\n";
  int count = 0;
  for (const ModelInfo& model : models()) {
    if (&model == &shown) continue;
    const std::string name(model.name), path = "materials." + name;
    const Vec3 corner(-1.75 + 0.5 * (count % 7), 1 + 0.5 * (count / 7), -0.125);
    const BodyDescription cube =
        body(name, name, shape(BoxDescription{corner, corner + Vec3::Constant(0.25)}));
    ++count;
    out += fmt::format("\n# {}\n", model.title);
    out += disabled(TomlWriter::table(explained, path, "[" + path + "]", material(name, model)));
    out += disabled("\n" + TomlWriter::table(explained, "bodies", "[[bodies]]", cube));
  }
  out +=
      "\n# In place of a model, a preset of those that 'firn materials' lists; its parameters may be set "
      "otherwise.\n";
  const Vec3 corner(-1.75 + 0.5 * (count % 7), 1 + 0.5 * (count / 7), -0.125);
  out += disabled(
      fmt::format("[materials.dune]\n{} = \"dry_sand\"\ndensity = 1900\n\n", kPresetKey) +
      TomlWriter::table(explained, "bodies", "[[bodies]]",
                        body("dune", "dune", shape(BoxDescription{corner, corner + Vec3::Constant(0.25)}))));
  return out;
}

std::string bodies_from_files(TomlWriter::Explained& explained) {
  const std::array kinds = {shape(MeshDescription{{"statue.obj", {}}}),
                            shape(LevelSetDescription{{"drift.vdb", {}}, "surface", {}}),
                            shape(ImageDescription{{"foam.####.png", {}}, {0.2, 0.2, 0.2}})};
  const std::array names = {"statue", "drift", "foam"};
  std::string out = "\n# Bodies from files.\n";
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const BodyDescription from_file = body(names[i], "snow", kinds[i]);
    out += disabled(TomlWriter::table(explained, "bodies", "[[bodies]]", from_file)) + "\n";
  }
  return out;
}

// On the plain path only, so not in a scene that someone may start from.
std::string forces(TomlWriter::Explained& explained) {
  BodyForceDescription wind;
  wind.acceleration[0].formula = "min(2 * t, 1) * cos(pi * y)";
  LoadDescription push;
  push.name = "push";
  push.region = shape(BoxDescription{{1.2, 0, -0.3}, {1.3, 0.4, 0.3}});
  push.force[0].number = -50;
  return "\n# Forces that vary, and forces on parts of bodies.\n" +
         disabled(TomlWriter::table(explained, "body_force", "[body_force]", wind)) +
         disabled("\n" + TomlWriter::table(explained, "loads", "[[loads]]", push));
}

}  // namespace

std::string example_scene() {
  const ModelInfo* snow = find_model("snow_stomakhin_2013");
  const ModelInfo& model = snow ? *snow : models().front();
  TomlWriter::Explained explained;
  std::string out =
      "# A Firn scene with every key. SI units; angles in degrees; vectors are [x, y, z] in every "
      "dimension.\n"
      "# Lines that start with '#' and no blank are alternatives.\n\n";
  // One after the other: a key is explained where the reader meets it first.
  out += TomlWriter::table(explained, "", "", live_scene(model));
  out += other_materials(explained, model);
  out += bodies_from_files(explained);
  out += forces(explained);
  return out;
}

}  // namespace firn
