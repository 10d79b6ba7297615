// The few system calls all output goes through, each checked: a call that fails ends in an Error that tells
// the user which file, why, how much room there is and what to do next. Interrupted calls and short writes
// are continued.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "engine/base/error.h"

namespace firn {

/// Bytes an ordinary user can still write to the file system that holds `path` (which may not exist yet, its
/// folder does); empty when the system cannot tell.
std::optional<std::uint64_t> free_bytes(const std::filesystem::path& path);

/// "cannot write out/a.vdb: No space left on device (needed: 12.0 MB, free: 0 B); ...next step". `needed` =
/// 0: unknown.
Error system_error(ExitCode code, const std::string& action, const std::filesystem::path& path,
                   int error_number, std::uint64_t needed = 0);

/// An open file that is closed when it goes out of scope.
class Descriptor {
 public:
  /// `flags` and `mode` as for open(2); close-on-exec is added.
  Descriptor(const std::filesystem::path& path, int flags, unsigned mode,
             ExitCode code_on_failure = ExitCode::io);
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }

  /// Writes all of [data, data + size) at `offset`. `needed` is only for the error message.
  void write_at(const char* data, std::size_t size, std::uint64_t offset, std::uint64_t needed = 0) const;
  void sync() const;
  std::uint64_t size() const;
  void truncate(std::uint64_t size) const;
  /// Closes now and reports what close(2) reports (a network file system may only then know of a failed
  /// write).
  void close();

 private:
  std::filesystem::path path_;
  int fd_;
};

/// Makes names that were created in, renamed in or removed from `folder` survive a power cut.
void sync_folder(const std::filesystem::path& folder);

/// rename(2), checked: `to` is replaced in one step or not at all.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// A write past `ulimit -f` or to a closed pipe then fails with an error number instead of killing the
/// program. To be called once, at the start of main.
void ignore_file_size_signals();

}  // namespace firn
