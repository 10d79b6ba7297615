#include "tools/cli/path/checks.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/scene/table_reader.h"
#include "tools/cli/path/fields.h"

namespace firn {
namespace {

using Keys = std::vector<std::string_view>;

/// What a test takes beside test, time and steps.
struct TestKeys {
  LabTest test;
  std::string_view required;
  Keys optional;
};

const TestKeys& keys_of(LabTest test) {
  static const std::array<TestKeys, 6> all = {{
      {LabTest::uniaxial, "strain", {"cycles", "until_stress"}},
      {LabTest::triaxial, "strain", {"lateral_pressure", "cycles", "until_stress"}},
      {LabTest::oedometer, "strain", {"cycles", "until_stress"}},
      {LabTest::simple_shear, "strain", {"normal_pressure", "cycles", "until_stress"}},
      {LabTest::isotropic, "pressure", {}},
      {LabTest::free, "strains", {"shear"}},
  }};
  return *std::find_if(all.begin(), all.end(), [&](const TestKeys& k) { return k.test == test; });
}

constexpr std::string_view kTestKeys[] = {"strain",           "strains",         "shear",  "pressure",
                                          "lateral_pressure", "normal_pressure", "cycles", "until_stress"};

/// What the faces are known to carry when a leg begins; empty where only the material can tell.
struct Carried {
  std::optional<double> axial = 0.0, sides = 0.0;  // Pa, positive in compression

  void after(const LegDescription& leg) {
    const bool ends = leg.until_stress.has_value();
    const auto end = ends ? std::optional(-*leg.until_stress) : std::nullopt;
    switch (leg.test) {
      case LabTest::uniaxial:
        axial = end, sides = 0.0;
        break;
      case LabTest::triaxial:
        axial = end;
        break;
      case LabTest::oedometer:
        axial = end, sides.reset();
        break;
      case LabTest::simple_shear:
        axial = leg.normal_pressure, sides.reset();
        break;
      case LabTest::isotropic:
        axial = sides = leg.pressure;
        break;
      case LabTest::free:
        axial.reset(), sides.reset();
        break;
    }
  }
};

std::string pressure_text(const std::optional<double>& carried) {
  return carried ? fmt::format("{:g} Pa", *carried) : "what the leg before leaves there";
}

/// A kept pressure must be there already: its jump in the first step would be no test any more.
void check_kept(TableReader& reader, std::size_t i, std::string_view key, double kept,
                const std::optional<double>& carried, std::string_view face) {
  if (carried && *carried == kept) return;
  reader.report(
      fmt::format("legs[{}].{}", i, key),
      fmt::format("{} must carry {:g} Pa when this leg begins, and carries {}; allowed: a leg with test = "
                  "\"isotropic\" and pressure = {:g} before it",
                  face, kept, pressure_text(carried), kept));
}

}  // namespace

void check(TableReader& reader, const LegDescription& d) {
  if (!reader.good({"test"})) return;
  const TestKeys& keys = keys_of(d.test);
  const std::string_view test = word_of(kLabTests, d.test);
  Keys known = {"test", "time", "steps", keys.required};
  known.insert(known.end(), keys.optional.begin(), keys.optional.end());
  if (!reader.has(keys.required))
    reader.report(keys.required, fmt::format("missing; test = \"{}\" needs it", test));
  for (const std::string_view key : kTestKeys)
    if (reader.has(key) && std::find(known.begin(), known.end(), key) == known.end())
      reader.report(key,
                    fmt::format("found with test = \"{}\"; its keys are: {}", test, fmt::join(known, ", ")));
  if (d.cycles && d.until_stress) reader.report("until_stress", "found beside cycles; allowed: one of them");
}

void check(TableReader& reader, const PathDescription& d) {
  if (!reader.good({"legs"})) return;
  constexpr std::int64_t kMostSteps = 10'000'000;
  std::int64_t steps = 0;
  Carried carried;
  for (std::size_t i = 0; i < d.legs.size(); ++i) {
    const LegDescription& leg = d.legs[i];
    if (leg.test == LabTest::uniaxial) check_kept(reader, i, "test", 0, carried.sides, "the side");
    if (leg.lateral_pressure)
      check_kept(reader, i, "lateral_pressure", *leg.lateral_pressure, carried.sides, "the side");
    if (leg.normal_pressure)
      check_kept(reader, i, "normal_pressure", *leg.normal_pressure, carried.axial, "the sheared face");
    carried.after(leg);
    steps += all_steps(leg);
  }
  if (steps > kMostSteps)
    reader.report("legs", fmt::format("found {} steps in all; allowed: at most {}", steps, kMostSteps));
}

}  // namespace firn
