// A scene that shows every key of the format.
#pragma once

#include <string>

#include "engine/scene/description.h"

namespace firn {

/// Runs as it stands. Lines that start with '#' and no blank are alternatives to be made live.
std::string example_scene();

}  // namespace firn
