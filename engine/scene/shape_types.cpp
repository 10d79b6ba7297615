#include "engine/scene/shape_types.h"

#include <algorithm>

#include "engine/base/check.h"

namespace firn {

const ShapeType& type_of(const ShapeDescription::Kind& kind) {
  const auto* combination = std::get_if<CombinationDescription>(&kind);
  const auto found = std::find_if(kShapeTypes.begin(), kShapeTypes.end(), [&](const ShapeType& type) {
    const ShapeDescription::Kind made = type.make();
    if (made.index() != kind.index()) return false;
    return !combination || std::get<CombinationDescription>(made).operation == combination->operation;
  });
  FIRN_CHECK(found != kShapeTypes.end());
  return *found;
}

}  // namespace firn
