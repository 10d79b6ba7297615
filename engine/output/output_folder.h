// The folder of one run: made, tested, locked and kept from holding the frames of two runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/output/posix_file.h"

namespace firn {

struct OutputFolderSettings {
  bool overwrite = false;            // the frames of an earlier run may go
  std::uint64_t expected_bytes = 0;  // what the run will write, as far as known
};

class OutputFolder {
 public:
  /// Makes the folder if need be and takes its lock; nothing that is in it changes. To be called before the
  /// simulation starts, so that these errors come at once:
  ///   environment: the folder cannot be made or written to; says why.
  ///   in_use:      another run writes to it (names host, process and start time), or it holds frames and
  ///   `overwrite`
  ///                is not set.
  OutputFolder(const std::filesystem::path& path, const OutputFolderSettings& settings);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path frame_file(int frame) const;

  /// A sentence for the user when the free space looks too small for the run; else empty.
  const std::string& warning() const { return warning_; }

  /// Removes every frame, diagnostics.csv and run.json of an earlier run and what a killed one left
  /// unfinished; other files stay. To be called right before the first frame is written: not earlier, so that
  /// a run that fails to start costs nothing; not frame by frame, so that an interrupted run does not leave a
  /// sequence that is half old.
  void remove_earlier_run();

 private:
  void take_lock();

  std::filesystem::path path_;
  // flock(2): the system frees it however the process ends, so a stale lock cannot exist. The file itself
  // stays: if it were removed, two runs could hold locks on two files of the same name.
  Descriptor lock_;
  std::string warning_;
};

}  // namespace firn
