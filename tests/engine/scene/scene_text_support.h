// What the tests of the scene reader share.
#pragma once

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/scene/reader.h"

namespace firn::test {

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A scene with nothing but what is required.
inline const std::string kSmallest = R"([simulation]
cell_size = 0.1
duration = 1

[materials.snow]
model = "snow_stomakhin_2013"

[[bodies]]
name = "ball"
material = "snow"
shape = { type = "sphere", center = [1, 2, 3], radius = 0.5 }
)";

inline SceneDescription read(std::string_view text, const std::vector<std::string>& overrides = {}) {
  return read_scene_text(text, "a.toml", overrides);
}

/// The whole message of a scene that must not be read; empty when it was.
template <class Read>
std::string error_of(Read&& read_it) {
  try {
    read_it();
  } catch (const Error& e) {
    return e.code() == ExitCode::input ? e.what() : "wrong exit code";
  }
  return "";
}
inline std::string error_in(std::string_view text, const std::vector<std::string>& overrides = {}) {
  return error_of([&] { read(text, overrides); });
}

}  // namespace firn::test
