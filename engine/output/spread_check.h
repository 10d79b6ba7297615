// Guards the grid a frame is stored in: a grid index wraps without a word beyond 2^31, and each particle far
// from all others costs a third of a megabyte of tree.
#pragma once

#include <span>

#include "engine/particles/frame_view.h"

namespace firn {

/// `positions`: three floats a particle, in m, in the frame's order.
/// Throws Error{ExitCode::numerics} naming the particle (by id) or the memory that would be needed.
void check_spread(const FrameView& frame, std::span<const float> positions, double voxel_size);

}  // namespace firn
