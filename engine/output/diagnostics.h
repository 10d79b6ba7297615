// diagnostics.csv: one row a frame, for plotting and for checking conservation. SI units; numbers in the
// shortest form that reads back to the same double.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/output/posix_file.h"
#include "engine/particles/frame_view.h"

namespace firn {

class Diagnostics {
 public:
  /// Starts a new file with the header. `counters` are the last columns: every clamp, cut and retry that can
  /// happen in this run, so that an absent one is known to be impossible rather than unreported.
  Diagnostics(const std::filesystem::path& file, std::vector<std::string> counters);

  /// Appends the row of one frame, and syncs it; a counter the frame does not name is 0.
  /// Throws Error{ExitCode::io}; the file then still ends with a whole row.
  void append(const FrameView& frame);

 private:
  void write_line(const std::string& line);

  Descriptor file_;
  std::vector<std::string> counters_;
  std::uint64_t end_ = 0;
};

}  // namespace firn
