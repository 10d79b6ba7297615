// What the parts of a pass take, from a few of its blocks: reading the clock in all of them would cost more
// than some of the parts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace firn {

/// Ticks by part. Blocks may be measured by several threads; begin and end are called by one.
class BlockSamples {
 public:
  void begin(std::size_t blocks, std::size_t parts) {
    stride_ = std::clamp<std::size_t>(blocks, 1, kStride);
    parts_ = parts;
    slots_.resize((blocks + stride_ - 1) / stride_ * parts);
    totals_.resize(parts);
  }
  /// The counters of a block, one a part; null when it is not measured this time.
  std::uint64_t* of(std::size_t block) {
    return block % stride_ == turn_ % stride_ ? slots_.data() + block / stride_ * parts_ : nullptr;
  }
  void end() {
    for (std::size_t k = 0; k < slots_.size(); ++k) totals_[k % parts_] += slots_[k];
    std::fill(slots_.begin(), slots_.end(), 0);
    ++turn_;
  }

  /// Which share of the pass each part took; the first one all of it when nothing was measured.
  std::vector<double> shares() const {
    std::vector<double> out(totals_.begin(), totals_.end());
    double sum = 0;
    for (const double ticks : out) sum += ticks;
    if (sum == 0 && !out.empty()) out[0] = sum = 1;
    for (double& ticks : out) ticks /= sum;
    return out;
  }

 private:
  static constexpr std::size_t kStride = 64;
  std::size_t stride_ = 1, parts_ = 0, turn_ = 0;
  std::vector<std::uint64_t> slots_, totals_;
};

}  // namespace firn
