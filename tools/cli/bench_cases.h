// The scenes `firn bench` brings along: a spinning box of a million particles, eight in a cell, in free
// space. No grid effect and no frame interrupts the steps, so that they cost what the method costs; the spin
// keeps particles crossing cells, so that sorting is part of it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/vector/isa.h"

namespace firn {

struct BenchCase {
  std::string_view name;
  std::string_view material;  // a table of the scene
};

inline constexpr BenchCase kBenchCases[] = {
    {"elastic", R"(model = "neo_hookean"
density = 400
youngs_modulus = 1.4e5
poissons_ratio = 0.2
)"},
    {"snow", R"(model = "snow_stomakhin_2013"
)"},
};
inline constexpr int kBenchSteps = 48;

/// Null when there is none of this name.
constexpr const BenchCase* find_bench_case(std::string_view name) {
  for (const BenchCase& c : kBenchCases)
    if (c.name == name) return &c;
  return nullptr;
}

/// What is measured when no scene is named.
struct BenchDefault {
  std::string_view name, precision;
  std::optional<Isa> isa;  // where it is not the widest one that the processor has; empty: the widest
};
inline constexpr BenchDefault kBenchDefaults[] = {
    {"elastic", "float", {}}, {"snow", "float", {}}, {"snow", "double", {}}, {"snow", "float", Isa::avx2}};

inline std::string bench_scene(const BenchCase& bench_case) {
  return R"([simulation]
cell_size = 0.02
duration = 10
frame_rate = 0.1
transfer = "mls"

[[bodies]]
name = "box"
material = "box"
shape = { type = "box", min = [-0.5, -0.5, -0.5], max = [0.5, 0.5, 0.5] }
particles_per_cell = 8
angular_velocity = [0, 400, 200]

[materials.box]
)" + std::string(bench_case.material);
}

}  // namespace firn
