// What `firn bench` measures: scenes, each on some numbers of threads and with some instruction sets.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/plan.h"
#include "tools/cli/bench.h"

namespace firn {

constexpr std::string_view name(Precision precision) {
  return precision == Precision::single ? "float" : "double";
}

/// A scene to be measured.
struct BenchSubject {
  std::string name;                    // as in BenchOptions::scenes
  std::vector<std::string> overrides;  // a.b=v, all that apply to it
  Plan plan;
};

/// One way to run it.
struct BenchRun {
  std::shared_ptr<const BenchSubject> subject;
  int threads;
  std::optional<Isa> isa;  // empty: the plain path

  Precision precision() const { return subject->plan.scene.simulation.precision; }
  std::string_view isa_name() const { return isa ? name(*isa) : "plain"; }
  /// "snow float avx512, 2 threads".
  std::string title() const;
};

/// What the options ask for, each run once, in the order in which it is reported. Throws Error.
std::vector<BenchRun> list_runs(const BenchOptions& options);

}  // namespace firn
