// A copy of a frame that outlives it: what a FrameView computes on demand, held in memory, so that the
// simulation can go on while a sink still reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/particles/frame_view.h"

namespace firn {

class FrameSnapshot {
 public:
  FrameSnapshot() = default;
  // Its view points into it.
  FrameSnapshot(const FrameSnapshot&) = delete;
  FrameSnapshot& operator=(const FrameSnapshot&) = delete;

  /// Copies everything of `frame`, which may be gone afterwards, on all threads. A second frame of the same
  /// size and attributes takes the place of the first without a new buffer. The frame's copy functions are
  /// called from several threads at once. Throws std::bad_alloc; the snapshot may then only be taken again.
  void take(const FrameView& frame);

  /// The frame as it was taken, bit for bit; valid until the next take().
  const FrameView& view() const { return view_; }

  /// The copy of attribute `i`, all components of particle 0 first.
  std::span<const float> values(std::size_t i) const { return values_[i]; }
  std::span<const std::int64_t> ids() const { return ids_; }

 private:
  bool has_attributes_of(const FrameView& frame) const;
  void lay_out(const FrameView& frame);

  std::vector<std::int64_t> ids_;
  std::vector<std::vector<float>> values_;  // as many as view_ has attributes
  FrameView view_;
};

}  // namespace firn
