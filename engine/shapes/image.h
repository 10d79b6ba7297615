// Solids from pictures and stacks of them.
//
// A pixel's value stands at its middle; between the middles it is interpolated linearly along each axis, and
// out to the rim of the picture it stays as it is. Solid is what lies on the chosen side of the threshold, in
// the box that the picture fills: rows from the top at the highest y, slices from the first at the lowest z,
// and a single picture is the same everywhere along z.
#pragma once

#include <filesystem>

#include "engine/shapes/raster.h"
#include "engine/shapes/shape.h"

namespace firn {

enum class SolidPixels { bright, dark };

/// The sign of phi is that of the interpolated values, its size a distance: at the middles of pixels that to
/// the surface (see surface_distance.h), between them a bound. Throws Error{input} where no pixel is solid.
ShapePtr make_image(const Raster& raster, const Bounds& box, double threshold, SolidPixels solid);

/// make_image of read_raster; messages name the file.
ShapePtr read_image(const std::filesystem::path& file, const Bounds& box, double threshold,
                    SolidPixels solid);

}  // namespace firn
