#include "tools/cli/study/scene_files.h"

#include <chrono>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "engine/scene/reader.h"

namespace firn {
namespace {

TEST_CASE("every file that a scene names is found, wherever its key stands") {
  const std::filesystem::path every_key = FIRN_TEST_DATA "/scenes/every_key.toml";
  std::vector<std::string> found = scene_files(read_scene(every_key));
  std::sort(found.begin(), found.end());
  CHECK(found == std::vector<std::string>{"drift.vdb", "foam.##.png", "grains.csv", "meshes/rock.obj"});
}

TEST_CASE("the stamp of a scene's files changes with any of them, slices of a stack too") {
  const auto folder = std::filesystem::temp_directory_path() / "firn_scene_files_test";
  std::filesystem::create_directories(folder);
  const auto slice = folder / "slice.0001.pgm";
  std::ofstream(slice) << "P2 1 1 1 1";
  const SceneDescription scene = read_scene_text(R"(
[simulation]
cell_size = 0.1
duration = 1
[materials.m]
model = "snow_stomakhin_2013"
[[bodies]]
name = "foam"
material = "m"
shape = { type = "image", file = "slice.####.pgm", size = [1, 1, 1] }
)",
                                                 folder / "scene.toml");
  const std::string before = scene_files_stamp(scene);
  CHECK(scene_files_stamp(scene) == before);
  std::filesystem::last_write_time(slice, std::filesystem::last_write_time(slice) + std::chrono::seconds(5));
  CHECK(scene_files_stamp(scene) != before);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace firn
