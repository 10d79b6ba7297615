#include "engine/grid/block_layout.h"

#include <bit>

namespace firn {
namespace {

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

template <int D>
std::uint64_t hash(const BlockCoord<D>& c) {
  std::uint64_t packed = 0;
  for (std::int32_t x : c) packed = packed << 20 | static_cast<std::uint32_t>(x + kMaxCell / 2);
  packed *= 0x9e3779b97f4a7c15;  // the golden ratio's bits spread what differs to the upper half
  return packed ^ packed >> 32;
}

}  // namespace

template <int D>
std::size_t BlockLayout<D>::slot(const BlockCoord<D>& coord) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t s = hash<D>(coord) & mask;
  while (table_[s] != kNone && coords_[table_[s]] != coord) s = (s + 1) & mask;
  return s;
}

template <int D>
std::uint32_t BlockLayout<D>::find(const BlockCoord<D>& coord) const {
  return table_.empty() ? kNone : table_[slot(coord)];
}

template <int D>
std::uint32_t BlockLayout<D>::add(const BlockCoord<D>& coord) {
  std::size_t s = slot(coord);
  if (table_[s] != kNone) return table_[s];
  const auto index = static_cast<std::uint32_t>(coords_.size());
  table_[s] = index;
  coords_.push_back(coord);
  if (2 * coords_.size() > table_.size()) {
    table_.assign(2 * table_.size(), kNone);
    for (std::uint32_t k = 0; k < coords_.size(); ++k) table_[slot(coords_[k])] = k;
  }
  return index;
}

template <int D>
void BlockLayout<D>::rebuild(std::span<const std::uint64_t> occupied) {
  coords_.clear();
  for (auto& blocks : colours_) blocks.clear();
  table_.assign(std::max(table_.size(), std::bit_ceil(4 * occupied.size() + 16)), kNone);
  for (std::uint64_t block : occupied) add(block_coord<D>(block));
  neighbours_.resize(occupied.size());
  for (std::size_t b = 0; b < occupied.size(); ++b) {
    const BlockCoord<D> c = coords_[b];
    for (int n = 0; n < kNeighbours<D>; ++n)
      neighbours_[b][static_cast<std::size_t>(n)] = add(neighbour_coord<D>(c, n));
    colours_[colour<D>(c)].push_back(static_cast<std::uint32_t>(b));
  }
  Neighbours none;
  none.fill(kNone);
  sources_.assign(coords_.size(), none);
  for (std::size_t b = 0; b < occupied.size(); ++b)
    for (std::size_t n = 0; n < kNeighbours<D>; ++n)
      sources_[neighbours_[b][n]][kNeighbours<D> - 1 - n] = static_cast<std::uint32_t>(b);
}

template <int D>
std::size_t BlockLayout<D>::bytes() const {
  std::size_t sum = coords_.capacity() * sizeof(BlockCoord<D>) + table_.capacity() * sizeof(std::uint32_t) +
                    (neighbours_.capacity() + sources_.capacity()) * sizeof(Neighbours);
  for (const auto& blocks : colours_) sum += blocks.capacity() * sizeof(std::uint32_t);
  return sum;
}

template class BlockLayout<1>;
template class BlockLayout<2>;
template class BlockLayout<3>;

}  // namespace firn
