// Makes the n-th system call of the output fail. The test program defines pwrite, fsync and rename itself, in
// front of the C library's.
#pragma once

namespace firn::testing {

/// Stands for "only part of the bytes was written" in place of an error number.
inline constexpr int kShortWrite = -1;

/// While it lives, call number `call` (from 1, over pwrite, fsync and rename together) fails with
/// `error_number`; with `persistent` all later calls of the same kind do too, as on a disk that stays full.
class FaultInjection {
 public:
  FaultInjection(int call, int error_number, bool persistent = false);
  ~FaultInjection();
  FaultInjection(const FaultInjection&) = delete;
  FaultInjection& operator=(const FaultInjection&) = delete;
  bool fired() const;
};

}  // namespace firn::testing
