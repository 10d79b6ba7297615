// The scene format for other programs: editors that complete and check keys, generators of scenes.
#pragma once

#include <string>

namespace firn {

/// A JSON Schema (draft 2020-12) of the tables of a scene. What ties several keys together (flip_ratio and
/// transfer, names that must exist) is not in it: the reader checks that.
std::string scene_schema();

}  // namespace firn
