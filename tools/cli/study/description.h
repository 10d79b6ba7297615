// A study as its file says it: a scene, what is true of it, and which settings are tried.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/problems.h"
#include "engine/base/vector_formula.h"

namespace firn {

/// What a formula of the truth can depend on: the place at the start, and the time.
inline constexpr std::array<std::string_view, 4> kTruthNames = {"X", "Y", "Z", "t"};

/// The displacement is known, of every body alike; velocity and stress follow from it.
struct ClosedForm {
  VectorQuantity displacement;  // m, of kTruthNames
};

/// What ever finer runs tend to.
struct FinestRuns {
  std::vector<double> cell_sizes;  // m, two or three, each the same factor smaller than the one before
  std::vector<std::string> set;    // KEY=VALUE, beside those of the study
};

/// A setting and the values it takes, as they stand in TOML.
struct Axis {
  std::string name;  // "cell_size" and other keys of [simulation], "particles_per_cell", "threads", or a
                     // scene's key with dots, as in "materials.rubber.youngs_modulus"
  std::vector<std::string> values;
  SourceMark mark;
};

/// Every combination of the axes' values.
struct Sweep {
  std::vector<Axis> axes;
  int sample = 0;  // so many of the combinations, at random; 0: all
};

struct StudyDescription {
  std::filesystem::path file;
  std::string title, description;
  std::filesystem::path scene;
  std::vector<std::string> set;  // KEY=VALUE, of every run
  int repeats = 5;               // of every run, for its seconds
  int threads = 1;
  std::uint64_t seed = 1;  // of samples
  std::variant<ClosedForm, FinestRuns> truth;
  std::vector<Sweep> sweeps;
};

}  // namespace firn
