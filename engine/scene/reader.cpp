#include "engine/scene/reader.h"

#include <sstream>

#include "engine/scene/overrides.h"
#include "engine/scene/scene_text.h"
#include "engine/scene/table_reader.h"

namespace firn {

SceneDescription read_scene(const std::filesystem::path& path, std::span<const std::string> overrides) {
  return read_scene_text(read_scene_file(path), path, overrides);
}

SceneDescription read_scene_text(std::string_view text, const std::filesystem::path& path,
                                 std::span<const std::string> overrides) {
  Report report(shown_path(path));
  SceneDescription scene;
  scene.file = path;
  if (auto table = parse_toml(text, report.file(), report)) {
    for (const std::string& text_of_one : overrides) apply_override(text_of_one, *table, report);
    TableReader::Context context{report, std::nullopt};
    read_all(context, *table, "", scene);
    std::ostringstream as_run;
    as_run << *table;
    scene.as_run = as_run.str();
  }
  report.throw_if_any();
  return scene;
}

}  // namespace firn
