// Union, intersection and difference by the minimum and maximum of distances. The sign is exact; the
// magnitude is never larger than the true distance, so it may be used to skip space.
#pragma once

#include <vector>

#include "engine/shapes/shape.h"

namespace firn {

/// At least one operand each.
ShapePtr make_union(std::vector<ShapePtr> operands);
ShapePtr make_intersection(std::vector<ShapePtr> operands);

/// The first operand less all others.
ShapePtr make_difference(std::vector<ShapePtr> operands);

}  // namespace firn
