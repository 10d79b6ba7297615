// A file that appears under its name only when it is whole. It is written under a temporary name in the same
// folder; commit() flushes, syncs, checks the size, renames and syncs the folder. Without commit() nothing
// remains, and a file that stood under the name before is untouched until the rename. So neither a full disk,
// nor a crash, nor a power cut leaves a torn file that looks finished.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>

namespace firn {

class CheckedFile {
 public:
  /// `expected_bytes` is only for the message on a full disk; 0: unknown.
  explicit CheckedFile(const std::filesystem::path& target, std::uint64_t expected_bytes = 0);
  ~CheckedFile();
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  /// Buffered and seekable. A failed write throws Error{ExitCode::io} out of the operation that caused it.
  std::ostream& stream();

  /// Returns the size of the file. Throws Error{ExitCode::io}; also when an earlier write failed and the code
  /// in between did not pass that on.
  std::uint64_t commit();

  /// The name used until commit(): ".name.partial" beside the target.
  static std::filesystem::path temporary_name(const std::filesystem::path& target);

 private:
  class Buffer;
  std::filesystem::path target_, temporary_;
  std::unique_ptr<Buffer> buffer_;
  std::ostream stream_;
  bool committed_ = false;
};

}  // namespace firn
