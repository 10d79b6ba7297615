// Numbers blocks in the order in which they are met. Keeps its memory.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace firn {

class BlockNumbers {
 public:
  void clear() {
    blocks_.clear();
    slots_.assign(slots_.size(), Slot{});
  }
  /// The blocks (block_of_key) by their numbers.
  const std::vector<std::uint64_t>& blocks() const { return blocks_; }

  /// New blocks get the next number. To be asked for every particle: in the order of particles the block
  /// changes too often for a branch to be foreseen, while the first slot is nearly always the right one.
  std::uint32_t operator()(std::uint64_t block) {
    for (std::size_t s = home(block);; s = (s + 1) & (slots_.size() - 1)) {
      if (slots_[s].block == block) return slots_[s].number;
      if (slots_[s].block == kEmpty) return add(block, s);
    }
  }
  std::size_t bytes() const {
    return blocks_.capacity() * sizeof(std::uint64_t) + slots_.capacity() * sizeof(Slot);
  }

 private:
  static constexpr std::uint64_t kEmpty = std::numeric_limits<std::uint64_t>::max();
  struct Slot {
    std::uint64_t block = kEmpty;
    std::uint32_t number = 0;
  };

  std::size_t home(std::uint64_t block) const {
    return static_cast<std::size_t>(block * 0x9e3779b97f4a7c15u >> 32) & (slots_.size() - 1);
  }
  std::uint32_t add(std::uint64_t block, std::size_t slot) {
    const auto number = static_cast<std::uint32_t>(blocks_.size());
    blocks_.push_back(block);
    slots_[slot] = {block, number};
    if (2 * blocks_.size() > slots_.size()) grow();
    return number;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), Slot{});
    for (std::uint32_t n = 0; n < blocks_.size(); ++n) {
      std::size_t s = home(blocks_[n]);
      while (slots_[s].block != kEmpty) s = (s + 1) & (slots_.size() - 1);
      slots_[s] = {blocks_[n], n};
    }
  }

  std::vector<std::uint64_t> blocks_;
  std::vector<Slot> slots_ = std::vector<Slot>(64);  // open addressing, a power of two, at most half full
};

}  // namespace firn
