// From a study file to its description.
#pragma once

#include "tools/cli/study/description.h"

namespace firn {

/// Throws Error{input} with every mistake of the file. What it says of the scene is not looked at.
StudyDescription read_study(const std::filesystem::path& path);

/// A commented study with every key.
std::string example_study();

}  // namespace firn
