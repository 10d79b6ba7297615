#include "tools/cli/study/scene_files.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "engine/scene/build_shape.h"
#include "engine/scene/fields.h"

namespace firn {
namespace {

/// The visitor of fields.h that looks for files and passes over all else.
class FileFinder {
 public:
  std::vector<std::string> found;

  void file(const Key&, const Name& name) { found.push_back(name.text); }
  void file(const Key&, const std::optional<Name>& name) {
    if (name) found.push_back(name->text);
  }
  void kind(const Key&, ShapeDescription::Kind& kind) {
    std::visit([&](auto& k) { fields(*this, k); }, kind);
  }
  template <class T>
  void section(const Key&, T& value) {
    fields(*this, value);
  }
  template <class T>
  void section(const Key&, std::optional<T>& value) {
    if (value) fields(*this, *value);
  }
  template <class T>
  void shape(const Key& key, T& value) {
    section(key, value);
  }
  template <class T>
  void list(const Key&, std::vector<T>& values) {
    for (T& value : values) fields(*this, value);
  }
  void shapes(const Key& key, std::vector<ShapeDescription>& values) { list(key, values); }

  template <class T>
  void real(const Key&, const T&, const Range&) {}
  template <class T>
  void integer(const Key&, const T&, const IntegerRange&) {}
  template <class... Rest>
  void choice(const Key&, const Rest&...) {}
  template <class... Rest>
  void text(const Key&, const Rest&...) {}
  template <class... Rest>
  void name(const Key&, const Rest&...) {}
  template <class... Rest>
  void vector(const Key&, const Rest&...) {}
  template <class... Rest>
  void quantities(const Key&, const Rest&...) {}
  template <class... Rest>
  void attributes(const Key&, const Rest&...) {}
  template <class... Rest>
  void model(const Key&, const Rest&...) {}
  template <class... Rest>
  void materials(const Key&, const Rest&...) {}
};

std::string written(const std::filesystem::path& path) {
  std::error_code none;  // a file that is gone has a time of its own
  return fmt::format("{} {}\n", path.string(),
                     std::filesystem::last_write_time(path, none).time_since_epoch().count());
}

}  // namespace

std::vector<std::string> scene_files(SceneDescription scene) {
  FileFinder finder;
  fields(finder, scene);
  return finder.found;
}

std::string scene_files_stamp(const SceneDescription& scene) {
  std::vector<std::string> lines;
  for (const std::string& name : scene_files(scene)) {
    const std::filesystem::path path = resolve_file(scene.file.parent_path(), name);
    lines.push_back(written(path));
    if (!names_a_stack(name)) continue;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), none))
      lines.push_back(written(entry.path()));
  }
  // A folder's entries come in any order.
  std::sort(lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : lines) out += line;
  return out;
}

}  // namespace firn
