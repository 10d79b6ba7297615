#include "engine/scene/checks.h"

#include <map>
#include <set>

#include <fmt/format.h>

#include "engine/base/nearest_name.h"
#include "engine/scene/fields.h"
#include "engine/scene/table_reader.h"
#include "engine/scene/with_kernel.h"

namespace firn {
namespace {

void check_contact(TableReader& reader, Contact contact) {
  if (contact != Contact::sticky || !reader.good({"contact"}) || !reader.has("friction")) return;
  reader.report("friction", "found a friction; allowed: none, for contact is \"sticky\"");
}

// A plane reaches to infinity, and so does all that is not cut off.
bool bounded(const ShapeDescription& shape) {
  if (std::holds_alternative<PlaneDescription>(shape.kind)) return false;
  const auto* combination = std::get_if<CombinationDescription>(&shape.kind);
  if (!combination || combination->operands.empty()) return true;
  const auto& operands = combination->operands;
  switch (combination->operation) {
    case CombinationDescription::Operation::unite:
      return std::all_of(operands.begin(), operands.end(), bounded);
    case CombinationDescription::Operation::subtract:
      return bounded(operands.front());
    case CombinationDescription::Operation::intersect:
      return std::any_of(operands.begin(), operands.end(), bounded);
  }
  return true;
}

void check_name(TableReader& reader, const std::string& name) {
  if (!name.empty() || !reader.has("name") || !reader.good({"name"})) return;
  reader.report("name", "found ''; allowed: a name that is not empty");
}

// The second and later of equal names.
template <class T>
void check_names(TableReader& reader, std::string_view list, const std::vector<T>& items) {
  std::map<std::string_view, std::size_t> first;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name.empty()) continue;
    const auto [other, fresh] = first.try_emplace(items[i].name, i);
    if (fresh) continue;
    reader.report(fmt::format("{}[{}].name", list, i),
                  fmt::format("found '{}' a second time; {}[{}] has that name already",
                              printable(items[i].name), list, other->second));
  }
}

void check_materials(TableReader& reader, const SceneDescription& d) {
  constexpr std::size_t kMostCompared = 200;  // bounds the cost of a hostile scene
  std::set<std::string_view> names;
  std::vector<std::string_view> known;
  for (const MaterialDescription& material : d.materials) {
    names.insert(material.name);
    if (known.size() < kMostCompared) known.push_back(material.name);
  }
  std::set<std::string_view> used;
  bool all_told = true;  // every body says which material it means, rightly or nearly so
  for (std::size_t i = 0; i < d.bodies.size(); ++i) {
    if (reader.context().report.full()) return;  // comparing more names would take long and show nothing
    const std::string& name = d.bodies[i].material.text;
    const bool exists = names.contains(name);
    const std::string_view meant = exists ? name : nearest_name(name, known);
    used.insert(meant);
    all_told = all_told && !meant.empty();
    if (exists || d.bodies[i].material.mark.file.empty()) continue;
    reader.report(fmt::format("bodies[{}].material", i), unknown_name("material", name, known));
  }
  for (const MaterialDescription& material : d.materials) {
    if (!all_told || used.contains(material.name)) continue;
    reader.context().report.add(material.mark, "materials." + printable(material.name),
                                "unused; remove it or name it in a body");
  }
}

struct ShapeCheck {
  TableReader& reader;

  void operator()(const SphereDescription&) const {}
  void operator()(const BoxDescription& d) const { check_corners(d.min, d.max); }
  void operator()(const CylinderDescription& d) const {
    if (reader.good({"start", "end"}) && d.start == d.end) {
      reader.report("end", "found the same point as start; allowed: another one");
    }
  }
  void operator()(const ConeDescription& d) const {
    if (reader.good({"base", "apex"}) && d.base == d.apex) {
      reader.report("apex", "found the same point as base; allowed: another one");
    }
  }
  void operator()(const PlaneDescription& d) const {
    if (reader.good({"normal"}) && d.normal.isZero(0)) {
      reader.report("normal", "found a vector of length 0; allowed: any other");
    }
  }
  void operator()(const MeshDescription&) const { check_solid("mesh"); }
  void operator()(const LevelSetDescription&) const { check_solid("level_set"); }
  void operator()(const ImageDescription& d) const {
    const int dimension = reader.context().dimension.value_or(0);
    if (dimension == 1)
      reader.report("type", "found 'image'; allowed in dimensions 2 and 3, and the scene has dimension 1");
    if (dimension == 2 && reader.good({"file"}) && names_a_stack(d.file.text)) {
      reader.report("file",
                    "found a stack of slices; allowed in dimension 3 only, and the scene has dimension 2");
    }
    for (int axis = 0; axis < dimension && reader.good({"size"}); ++axis) {
      if (d.size[axis] > 0) continue;
      reader.report(fmt::format("size[{}]", axis),
                    fmt::format("found {}; allowed: a number > 0 (m)", d.size[axis]));
    }
  }
  void operator()(const CombinationDescription&) const {}

  void check_solid(std::string_view type) const {
    const std::optional<int> dimension = reader.context().dimension;
    if (!dimension || *dimension == 3) return;
    reader.report("type",
                  fmt::format("found '{}'; allowed in dimension 3 only, and the scene has dimension {}", type,
                              *dimension));
  }

  void check_corners(const Vec3& min, const Vec3& max) const {
    if (!reader.good({"min", "max"})) return;
    for (int axis = 0; axis < reader.context().dimension.value_or(0); ++axis) {
      if (min[axis] < max[axis]) continue;
      reader.report(
          fmt::format("max[{}]", axis),
          fmt::format("found {}; allowed: a number > {}, which min has there", max[axis], min[axis]));
    }
  }
};

}  // namespace

void check(TableReader& reader, const SimulationDescription& d) {
  if (reader.good({"dimension"})) reader.context().dimension = d.dimension;
  if (d.flip_ratio && d.transfer != Transfer::flip && reader.good({"transfer"})) {
    reader.report("flip_ratio", "found a ratio; allowed: none, for transfer is not \"flip\"");
  }
  const bool affine = d.transfer == Transfer::apic || d.transfer == Transfer::mls;
  const bool supports = with_kernel(d.kernel, [](auto kernel) { return kernel.affine; });
  if (affine && !supports && reader.good({"kernel", "transfer"})) {
    reader.report("kernel",
                  fmt::format("found '{}' with transfer '{}'; allowed: 'quadratic' and 'cubic', or transfer "
                              "'flip' or 'pic': an affine velocity takes sum S (x_i - x_p)^2 to be the same "
                              "wherever the particle is",
                              word_of(kKernels, d.kernel), word_of(kTransfers, d.transfer)));
  }
}

void check(TableReader&, const Vec3&) {}
void check(TableReader&, const MaterialDescription&) {}
void check(TableReader&, const KeyFrame&) {}
void check(TableReader&, const BodyForceDescription&) {}
void check(TableReader& reader, const LoadDescription& d) {
  check_name(reader, d.name);
}
void check(TableReader&, const OutputDescription&) {}

void check(TableReader& reader, const ShapeDescription& d) {
  if (reader.good({"type"})) std::visit(ShapeCheck{reader}, d.kind);
}

void check(TableReader& reader, const BodyDescription& d) {
  const bool shape = reader.has("shape"), points = reader.has("points");
  if (!shape && !points) reader.report("", "found neither shape nor points; allowed: one of them");
  if (shape && points) reader.report("points", "found points beside a shape; allowed: one of them");
  if (points && !shape && reader.has("sampling")) {
    reader.report("sampling", "found a sampling; allowed: none, for points are given");
  }
  check_name(reader, d.name);
  if (d.shape && reader.good({"shape"}) && !bounded(*d.shape)) {
    reader.report("shape",
                  "found a shape that reaches to infinity; allowed: planes only to cut another shape with");
  }
}

void check(TableReader& reader, const ColliderDescription& d) {
  check_contact(reader, d.contact);
  check_name(reader, d.name);
  if (!reader.good({"keyframes"})) return;
  for (std::size_t i = 1; i < d.keyframes.size(); ++i) {
    if (d.keyframes[i].time > d.keyframes[i - 1].time) continue;
    reader.report(fmt::format("keyframes[{}].time", i),
                  fmt::format("found {}; allowed: a number > {}, the time of the key frame before",
                              d.keyframes[i].time, d.keyframes[i - 1].time));
  }
}

void check(TableReader& reader, const DomainDescription& d) {
  ShapeCheck{reader}.check_corners(d.min, d.max);
  check_contact(reader, d.contact);
}

void check(TableReader& reader, const SceneDescription& d) {
  check_names(reader, "bodies", d.bodies);
  check_names(reader, "colliders", d.colliders);
  check_names(reader, "loads", d.loads);
  if (reader.has("materials") && !d.bodies.empty()) check_materials(reader, d);
}

}  // namespace firn
