#include "engine/scene/build_shape.h"

#include <cmath>
#include <variant>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/shapes/combination.h"
#include "engine/shapes/file_bytes.h"
#include "engine/shapes/image.h"
#include "engine/shapes/level_set.h"
#include "engine/shapes/mesh_import.h"
#include "engine/shapes/primitives.h"
#include "engine/shapes/transformed.h"

namespace firn {
namespace {

constexpr double kEndless = 1e9;  // m

class Builder {
 public:
  Builder(const std::filesystem::path& folder, std::vector<std::string>& warnings, Problems& problems)
      : folder_(folder), warnings_(warnings), problems_(problems) {}

  ShapePtr build(const ShapeDescription& d, double voxel, const std::string& key) {
    const Place place{d.mark, key, voxel / d.scale};
    if (!(d.scale > 0) || !std::isfinite(d.scale)) return refuse(place, "scale", "must be greater than 0");
    if (!d.rotate.allFinite()) return refuse(place, "rotate", "must be finite");
    if (!d.translate.allFinite()) return refuse(place, "translate", "must be finite");
    const ShapePtr shape = std::visit([&](const auto& kind) { return make(kind, place); }, d.kind);
    return shape ? make_transformed(shape, d.scale, d.rotate, d.translate) : nullptr;
  }

 private:
  struct Place {
    SourceMark mark;
    std::string key;
    double voxel;  // in the shape's own, unscaled units
  };

  ShapePtr refuse(const Place& place, const std::string& parameter, const std::string& why) {
    problems_.add(place.mark, place.key + "." + parameter, why);
    return nullptr;
  }

  ShapePtr make(const SphereDescription& d, const Place& place) {
    if (!d.center.allFinite()) return refuse(place, "center", "must be finite");
    if (!positive(d.radius)) return refuse(place, "radius", "must be greater than 0");
    return make_sphere(d.center, d.radius);
  }

  ShapePtr make(const BoxDescription& d, const Place& place) {
    if (!d.min.allFinite() || !d.max.allFinite()) return refuse(place, "min", "min and max must be finite");
    // A plane scene has 0 on the axes that it lacks: the box has no end along them.
    const auto lacking = d.min.array() == 0 && d.max.array() == 0;
    const Vec3 min = lacking.select(-kEndless, d.min), max = lacking.select(kEndless, d.max);
    if (!(min.array() < max.array()).all())
      return refuse(place, "max", "must be greater than min along each axis");
    return make_box(min, max);
  }

  ShapePtr make(const CylinderDescription& d, const Place& place) {
    if (!positive((d.end - d.start).norm()))
      return refuse(place, "end", "must be finite and differ from start");
    if (!positive(d.radius)) return refuse(place, "radius", "must be greater than 0");
    return make_cylinder(d.start, d.end, d.radius);
  }

  ShapePtr make(const ConeDescription& d, const Place& place) {
    if (!positive((d.apex - d.base).norm()))
      return refuse(place, "apex", "must be finite and differ from base");
    if (!positive(d.radius)) return refuse(place, "radius", "must be greater than 0");
    return make_cone(d.base, d.apex, d.radius);
  }

  ShapePtr make(const PlaneDescription& d, const Place& place) {
    if (!d.point.allFinite()) return refuse(place, "point", "must be finite");
    if (!positive(d.normal.norm())) return refuse(place, "normal", "must be finite and not zero");
    return make_plane(d.point, d.normal);
  }

  ShapePtr make(const MeshDescription& d, const Place& place) {
    const std::filesystem::path file = resolve_file(folder_, d.file.text);
    return guarded(d.file, place, [&] {
      return level_set_from_mesh(import_mesh(file), quoted(file), place.voxel, warnings_);
    });
  }

  ShapePtr make(const LevelSetDescription& d, const Place& place) {
    const std::filesystem::path file = resolve_file(folder_, d.file.text);
    return guarded(d.file, place, [&] { return read_level_set(file, d.grid, d.threshold); });
  }

  ShapePtr make(const ImageDescription& d, const Place& place) {
    const bool plane = d.size.z() == 0 && !names_a_stack(d.file.text);
    const bool positive_size = d.size.x() > 0 && d.size.y() > 0 && (plane || d.size.z() > 0);
    if (!positive_size || !d.size.allFinite())
      return refuse(place, "size", "must be finite and greater than 0 along each axis");
    const Bounds box =
        plane ? Bounds{{0, 0, -kEndless}, {d.size.x(), d.size.y(), kEndless}} : Bounds{Vec3::Zero(), d.size};
    const std::filesystem::path file = resolve_file(folder_, d.file.text);
    return guarded(d.file, place, [&] { return read_image(file, box, d.threshold, d.solid); });
  }

  ShapePtr make(const CombinationDescription& d, const Place& place) {
    std::vector<ShapePtr> operands;
    bool complete = true;
    for (std::size_t i = 0; i < d.operands.size(); ++i) {
      operands.push_back(build(d.operands[i], place.voxel, fmt::format("{}.operands[{}]", place.key, i)));
      complete = complete && operands.back();
    }
    if (operands.empty()) return refuse(place, "operands", "must name at least one shape");
    if (!complete) return nullptr;
    using Operation = CombinationDescription::Operation;
    switch (d.operation) {
      case Operation::unite:
        return make_union(std::move(operands));
      case Operation::subtract:
        return make_difference(std::move(operands));
      case Operation::intersect:
        return make_intersection(std::move(operands));
    }
    return nullptr;
  }

  template <class Load>
  ShapePtr guarded(const Name& file, const Place& place, Load load) {
    try {
      return load();
    } catch (const Error& error) {
      if (error.code() != ExitCode::input) throw;
      problems_.add(file.mark.file.empty() ? place.mark : file.mark, place.key + ".file", error.what());
      return nullptr;
    }
  }

  static bool positive(double x) { return x > 0 && std::isfinite(x); }

  const std::filesystem::path& folder_;
  std::vector<std::string>& warnings_;
  Problems& problems_;
};

}  // namespace

ShapePtr build_shape(const ShapeDescription& description, const std::filesystem::path& scene_folder,
                     double voxel, std::vector<std::string>& warnings, Problems& problems,
                     const std::string& key) {
  return Builder(scene_folder, warnings, problems).build(description, voxel, key);
}

std::filesystem::path resolve_file(const std::filesystem::path& scene_folder, const std::string& name) {
  return scene_folder / name;
}

}  // namespace firn
