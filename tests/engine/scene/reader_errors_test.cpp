// Every class of mistake in a scene, word for word: tests/data/scenes/bad/NAME.toml beside NAME.txt, where
// <models> stands for the names of all models.
#include <algorithm>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "materials/model_info.h"
#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {
namespace {

void replace(std::string& text, std::string_view what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at != std::string::npos) text.replace(at, what.size(), by);
}

std::string expected_text(const std::filesystem::path& file) {
  std::vector<std::string_view> names;
  for (const ModelInfo& model : models()) names.push_back(model.name);
  std::string text = slurp(file);
  replace(text, "<models>", fmt::format("{}", fmt::join(names, ", ")));
  replace(text, "<\"models\">", fmt::format("\"{}\"", fmt::join(names, "\", \"")));
  return text;
}

std::vector<std::filesystem::path> bad_scenes() {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(FIRN_TEST_DATA "/scenes/bad")) {
    if (entry.path().extension() == ".toml") out.push_back(entry.path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST_CASE("every class of mistake is reported word for word at its line and column") {
  const auto scenes = bad_scenes();
  REQUIRE(scenes.size() >= 100);
  for (std::filesystem::path path : scenes) {
    const std::string text = slurp(path);
    const std::string name = path.filename().string();
    CAPTURE(name);
    const std::string error = error_of([&] { read_scene_text(text, name); });
    CHECK(error + "\n" == expected_text(path.replace_extension(".txt")));
  }
}

TEST_CASE("a scene of very many mistakes shows two hundred of them and counts the rest") {
  std::string text = kSmallest + "[domain]\n";
  for (int i = 0; i < 100'000; ++i) text += fmt::format("k{} = {}\n", i, i);
  const std::string error = error_in(text);
  CHECK(std::count(error.begin(), error.end(), '\n') == 200);
  // min and max are missing, too.
  CHECK(error.substr(error.rfind('\n') + 1) == "a.toml: and 99802 more mistakes");
}

TEST_CASE("a typo in a material's name is not reported a second time as an unused material") {
  std::string text = kSmallest;
  replace(text, "material = \"snow\"", "material = \"sonw\"");
  CHECK(error_in(text) ==
        "a.toml:10:12: bodies[0].material: unknown material 'sonw'; did you mean 'snow'? known: snow");
}

}  // namespace
}  // namespace firn::test
