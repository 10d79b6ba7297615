// Random numbers by counting: a number depends on its key and index only, never on what was drawn before, so
// that particles come out the same in any order and on any number of threads.
#pragma once

#include <array>
#include <cstdint>

#include "engine/shapes/shape.h"

namespace firn {

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): a bijection that flips each output bit with
/// probability one half when one input bit flips.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr std::uint64_t body_key(std::uint64_t seed, std::size_t body) {
  return mixed(mixed(seed) + body);
}

/// Three numbers strictly between 0 and 1 from 21 bits each. They keep 2^-22 away from both ends, so a
/// jittered point does not round into its neighbour's stratum.
inline Vec3 unit_vector(std::uint64_t random) {
  constexpr std::uint64_t mask = (std::uint64_t{1} << 21) - 1;
  const auto unit = [](std::uint64_t bits) { return (static_cast<double>(bits) + 0.5) / 2097152.0; };
  return {unit(random & mask), unit((random >> 21) & mask), unit((random >> 42) & mask)};
}

inline Vec3 jitter(std::uint64_t key, const std::array<std::int64_t, 3>& cell) {
  std::uint64_t h = key;
  for (std::int64_t c : cell) h = mixed(h + static_cast<std::uint64_t>(c));
  return unit_vector(h);
}

}  // namespace firn
