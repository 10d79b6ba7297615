// The words that `type` of a shape takes, and the kind of shape each stands for.
#pragma once

#include <array>
#include <string_view>

#include "engine/scene/description.h"

namespace firn {

struct ShapeType {
  std::string_view word, meaning;
  ShapeDescription::Kind (*make)();
};

namespace detail {
template <class K>
ShapeDescription::Kind make_kind() {
  return K{};
}
template <CombinationDescription::Operation operation>
ShapeDescription::Kind make_combination() {
  return CombinationDescription{operation, {}};
}
}  // namespace detail

inline constexpr std::array<ShapeType, 11> kShapeTypes = {{
    {"sphere", "a disc in 2D, an interval in 1D", detail::make_kind<SphereDescription>},
    {"box", "along the axes, unless rotated", detail::make_kind<BoxDescription>},
    {"cylinder", "with flat caps", detail::make_kind<CylinderDescription>},
    {"cone", "with a flat base", detail::make_kind<ConeDescription>},
    {"plane", "a half-space: for colliders, or to cut another shape with",
     detail::make_kind<PlaneDescription>},
    {"mesh", "3D only", detail::make_kind<MeshDescription>},
    {"level_set", "3D only", detail::make_kind<LevelSetDescription>},
    {"image", "a picture; in 3D the same all along z, or a stack of slices",
     detail::make_kind<ImageDescription>},
    {"union", "all of them", detail::make_combination<CombinationDescription::Operation::unite>},
    {"difference", "the first less all others",
     detail::make_combination<CombinationDescription::Operation::subtract>},
    {"intersection", "what all have in common",
     detail::make_combination<CombinationDescription::Operation::intersect>},
}};

/// The entry whose kind (and, for combinations, operation) this is.
const ShapeType& type_of(const ShapeDescription::Kind& kind);

}  // namespace firn
