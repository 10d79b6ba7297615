#include "engine/grid/block_layout.h"

#include <unordered_map>

namespace firn {
namespace {

template <int D>
std::uint64_t pack(const BlockCoord<D>& c) {
  std::uint64_t out = 0;
  for (std::int32_t x : c) out = out << 20 | static_cast<std::uint32_t>(x + kMaxCell / 2);
  return out;
}

template <int D>
BlockCoord<D> neighbour_coord(BlockCoord<D> c, int n) {
  for (int d = D - 1; d >= 0; --d) {
    c[static_cast<std::size_t>(d)] += n % 3 - 1;
    n /= 3;
  }
  return c;
}

template <int D>
std::size_t colour(const BlockCoord<D>& c) {
  std::size_t out = 0;
  for (std::int32_t x : c) out = out * 3 + static_cast<std::size_t>((x % 3 + 3) % 3);
  return out;
}

}  // namespace

template <int D>
BlockLayout<D>::BlockLayout(std::span<const std::uint64_t> occupied) {
  std::unordered_map<std::uint64_t, std::uint32_t> index;
  index.reserve(occupied.size() * 4);
  const auto add = [&](const BlockCoord<D>& c) {
    const auto [it, is_new] = index.try_emplace(pack<D>(c), static_cast<std::uint32_t>(coords_.size()));
    if (is_new) coords_.push_back(c);
    return it->second;
  };
  for (std::uint64_t block : occupied) add(block_coord<D>(block));
  neighbours_.resize(occupied.size());
  for (std::size_t b = 0; b < occupied.size(); ++b) {
    const BlockCoord<D> c = coords_[b];
    for (int n = 0; n < kNeighbours<D>; ++n)
      neighbours_[b][static_cast<std::size_t>(n)] = add(neighbour_coord<D>(c, n));
    colours_[colour<D>(c)].push_back(static_cast<std::uint32_t>(b));
  }
}

template class BlockLayout<1>;
template class BlockLayout<2>;
template class BlockLayout<3>;

}  // namespace firn
