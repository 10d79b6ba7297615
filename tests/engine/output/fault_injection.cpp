#include "tests/engine/output/fault_injection.h"

#include <cerrno>
#include <cstddef>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace firn::testing {
namespace {

enum class Call { none, write, sync, rename };

struct State {
  int countdown = 0;  // 0: off
  int error_number = 0;
  bool persistent = false;
  Call fired = Call::none;
} state;

bool fails(Call call) {
  if (state.countdown > 0 && --state.countdown == 0) {
    state.fired = call;
    return true;
  }
  return state.persistent && state.fired == call;
}

int error() {
  errno = state.error_number;
  return -1;
}

}  // namespace

FaultInjection::FaultInjection(int call, int error_number, bool persistent) {
  state = {call, error_number, persistent, Call::none};
}
FaultInjection::~FaultInjection() {
  state = {};
}
bool FaultInjection::fired() const {
  return state.fired != Call::none;
}

extern "C" {

ssize_t pwrite(int fd, const void* data, std::size_t size, off_t offset) {
  if (fails(Call::write)) {
    if (state.error_number != kShortWrite) return error();
    size = (size + 1) / 2;
  }
  return syscall(SYS_pwrite64, fd, data, size, offset);
}

int fsync(int fd) {
  if (fails(Call::sync) && state.error_number != kShortWrite) return error();
  return static_cast<int>(syscall(SYS_fsync, fd));
}

// The C library's declaration promises not to throw, so this one must too.
int rename(const char* from, const char* to) noexcept {
  if (fails(Call::rename) && state.error_number != kShortWrite) return error();
  return static_cast<int>(syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

}  // extern "C"

}  // namespace firn::testing
