// R10: at least 95 % of keys with one typo get the right suggestion.
#include <random>

#include <catch2/catch.hpp>

#include "engine/scene/example.h"
#include "tests/engine/scene/scene_text_support.h"

namespace firn::test {
namespace {

// One letter left out, doubled by another, replaced, or swapped with its neighbour.
std::string with_typo(std::string word, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const char letter = static_cast<char>('a' + below(26));
  const std::size_t at = below(word.size());
  switch (below(4)) {
    case 0:
      word.erase(at, 1);
      break;
    case 1:
      word.insert(at, 1, letter);
      break;
    case 2:
      word[at] = letter;
      break;
    default:
      if (at + 1 < word.size()) std::swap(word[at], word[at + 1]);
  }
  return word;
}

TEST_CASE("at least 95 of 100 mistyped keys are told the key that was meant") {
  const std::string scene = example_scene();
  std::mt19937 random(20130721);  // the same typos on every machine
  int typos = 0, hits = 0;
  for (std::size_t begin = 0; begin < scene.size(); begin = scene.find('\n', begin) + 1) {
    const std::string key = scene.substr(begin, scene.find_first_of(" #[\n", begin) - begin);
    if (key.empty()) continue;  // no line of the form KEY = VALUE
    for (int i = 0; i < 10; ++i) {
      const std::string typo = with_typo(key, random);
      if (typo == key || typo.empty()) continue;
      std::string mistyped = scene;
      mistyped.replace(begin, key.size(), typo);
      const std::string error = error_in(mistyped);
      if (error.find("unknown key '" + typo + "'") == std::string::npos) continue;  // it made another key
      ++typos;
      hits +=
          error.find("unknown key '" + typo + "'; did you mean '" + key + "'?") != std::string::npos ? 1 : 0;
    }
  }
  CAPTURE(typos, hits);
  CHECK(typos > 500);
  CHECK(hits >= 0.95 * typos);
}

}  // namespace
}  // namespace firn::test
