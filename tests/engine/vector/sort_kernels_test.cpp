#include <random>

#include <catch2/catch.hpp>
#include <tbb/cache_aligned_allocator.h>

#include "engine/grid/kernel.h"
#include "engine/passes/plain_sort_kernels.h"
#include "engine/vector/isa.h"

using namespace firn;

namespace {

template <class Real>
using Values = std::vector<Real, tbb::cache_aligned_allocator<Real>>;  // kernels load whole registers

constexpr std::size_t kTiles = 40, kParticles = kTiles * kTile;

}  // namespace

#define FIRN_REALS_AND_DIMENSIONS \
  ((class Real, int D), Real, D), (float, 2), (float, 3), (double, 2), (double, 3)

TEMPLATE_TEST_CASE_SIG("every instruction set finds the cells of the plain path, bit for bit", "[vector]",
                       FIRN_REALS_AND_DIMENSIONS) {
  const Real h = Real(0.07);  // no binary fraction, so that cells of border points are a matter of rounding
  std::mt19937 random(31);
  std::uniform_real_distribution<Real> place(-100, 100);
  Values<Real> position(kParticles * D);
  for (std::size_t i = 0; i < position.size(); ++i)
    position[i] = i % 2 == 0 ? place(random) : std::round(2 * place(random)) / 2 * h;
  std::uint64_t expected[kTile], keys[kTile];
  for (const Isa isa : kIsas) {
    if (!available(isa)) continue;
    CAPTURE(name(isa));
    for (std::size_t tile = 0; tile < kTiles; ++tile) {
      const Real* x = position.data() + tile * kTile * D;
      plain_sort_kernels<QuadraticKernel, Real, D>().cell_keys(x, kTile, 1 / h, expected);
      sort_kernels<Real, D>(isa).cell_keys(x, kTile, 1 / h, keys);
      REQUIRE(std::equal(std::begin(keys), std::end(keys), std::begin(expected)));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("every instruction set moves particles from where they were, near or far", "[vector]",
                       FIRN_REALS_AND_DIMENSIONS) {
  const std::size_t spread = GENERATE(1, 40, kParticles);  // in order; within few tiles; anywhere
  const int width = GENERATE(1, D, D * (D + 1) / 2, D * D);
  CAPTURE(spread, width);
  std::mt19937 random(32);
  std::vector<std::uint32_t> source(kParticles);
  for (std::size_t i = 0; i < kParticles; ++i)
    source[i] = static_cast<std::uint32_t>((i + random() % spread) % kParticles);
  Values<Real> from(kParticles * static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<Real>(i);
  Values<Real> expected(from.size());
  move_tiles(from.data(), expected.data(), source.data(), kTiles, width);
  for (const Isa isa : kIsas) {
    if (!available(isa)) continue;
    CAPTURE(name(isa));
    Values<Real> to(from.size());
    sort_kernels<Real, D>(isa).move(from.data(), to.data(), source.data(), kTiles, width);
    REQUIRE((to == expected));  // in brackets: not to be printed
  }
}
