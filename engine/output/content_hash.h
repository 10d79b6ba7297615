// One number for what a frame holds, to tell whether two runs gave the same particles bit for bit. Files
// cannot be compared for that: each .vdb carries a random identifier.
#pragma once

#include <cstdint>

#include "engine/particles/frame_view.h"

namespace firn {

/// XXH3 (64 bits) over the bytes of each particle (id, then every attribute of `frame` in its order), these
/// summed modulo 2^64, then hashed together with the particle count and the attributes' names and sizes. The
/// sum makes it independent of the order of the particles, so of sorting and of threads. Bits count: 0 and -0
/// differ. Frame number and time do not enter.
/// The frame's copy functions are called from several threads at once.
std::uint64_t content_hash(const FrameView& frame);

}  // namespace firn
