// A frame made of random particles, as a simulation would hand it to the sinks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "engine/particles/frame_view.h"

namespace firn::testing {

struct SampleFrame {
  std::vector<std::int64_t> id;
  std::vector<float> P, v, F_E, Jp, material;

  /// Particles in a cube of edge 1 about `center`; ids that neither start at 0 nor fit 32 bits.
  explicit SampleFrame(std::size_t particles, float center = 0) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
    id.resize(particles);
    std::iota(id.begin(), id.end(), std::int64_t{5'000'000'000});
    std::shuffle(id.begin(), id.end(), random);
    const auto fill = [&](std::size_t components, float offset) {
      std::vector<float> out(particles * components);
      for (float& x : out) x = offset + unit(random);
      return out;
    };
    P = fill(3, center);
    v = fill(3, 0);
    F_E = fill(9, 1);
    Jp = fill(1, 1);
    material.resize(particles);
    for (std::size_t i = 0; i < particles; ++i) material[i] = static_cast<float>(i % 3);
  }

  static AttributeView column(std::string name, int components, const std::vector<float>& values) {
    return {std::move(name), components, [components, &values](std::size_t first, std::span<float> out) {
              std::copy_n(&values[first * static_cast<std::size_t>(components)], out.size(), out.begin());
            }};
  }

  /// Valid as long as this sample is.
  FrameView view() const {
    FrameView out;
    out.frame = 12;
    out.time = 0.4375;
    out.particles = id.size();
    out.copy_id = [this](std::size_t first, std::span<std::int64_t> to) {
      std::copy_n(&id[first], to.size(), to.begin());
    };
    out.attributes = {
        column("P", 3, P),
        column("v", 3, v),
        {"pscale", 1, [](std::size_t, std::span<float> to) { std::fill(to.begin(), to.end(), 0.25F); }},
        column("F_E", 9, F_E),
        column("Jp", 1, Jp),
        column("material", 1, material)};
    return out;
  }
};

}  // namespace firn::testing
