#include "engine/shapes/child_process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

enum ChildExit : int { kAnswered = 0, kRefused = 10, kOutOfMemory = 11 };

constexpr std::size_t kLongestMessage = 1000;

// Sanitizers map terabytes that they never touch: no limit on address space means anything then.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kShadowMemory = true;
#else
constexpr bool kShadowMemory = false;
#endif

void set_limit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit limit{soft, hard};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit);
}

std::uint64_t mapped_bytes() {
  unsigned long long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void confine(const ChildLimits& limits) {
  // A test framework's or the program's own handlers have no business in the child.
  for (int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGINT, SIGHUP, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ::prctl(PR_SET_DUMPABLE, 0);
  if (const int null = ::open("/dev/null", O_RDWR); null >= 0) {
    for (int standard : {0, 1, 2}) ::dup2(null, standard);
  }
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_FSIZE, 0, 0);
  set_limit(RLIMIT_CPU, limits.cpu_seconds, limits.cpu_seconds + 1);
  if (!kShadowMemory) {
    const std::uint64_t space = mapped_bytes() + limits.memory;
    set_limit(RLIMIT_AS, space, space);
  }
  if (!limits.opens_files) set_limit(RLIMIT_NOFILE, 0, 0);
}

void send(int descriptor, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(descriptor, bytes, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(kRefused);
    bytes += n;
    size -= static_cast<std::size_t>(n);
  }
}

[[noreturn]] void run_child(int answer, const ChildLimits& limits,
                            const std::function<std::vector<std::uint8_t>()>& work) {
  // Leaves by _exit only: the parent's buffers and static objects are not the child's to flush or destroy.
  try {
    confine(limits);
    const std::vector<std::uint8_t> bytes = work();
    send(answer, bytes.data(), bytes.size());
    ::_exit(kAnswered);
  } catch (const std::bad_alloc&) {
    ::_exit(kOutOfMemory);
  } catch (const std::exception& error) {
    send(answer, error.what(), std::min(std::strlen(error.what()), kLongestMessage));
    ::_exit(kRefused);
  } catch (...) {
    ::_exit(kRefused);
  }
}

enum class Reading { complete, too_much, too_long };

Reading read_answer(int descriptor, const ChildLimits& limits, std::vector<std::uint8_t>& bytes) {
  // Wall time only catches a child that waits for something; on a busy machine the processor limit strikes
  // first.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30 + 8 * limits.cpu_seconds);
  std::vector<std::uint8_t> piece(std::size_t{1} << 16);
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return Reading::too_long;
    pollfd waiting{descriptor, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;
    const ssize_t n = ::read(descriptor, piece.data(), piece.size());
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (n <= 0) return Reading::complete;
    if (bytes.size() + static_cast<std::size_t>(n) > limits.answer) return Reading::too_much;
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + n);
  }
}

int reap(pid_t child, bool stop) {
  if (stop) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string what_went_wrong(Reading reading, int status, const ChildLimits& limits,
                            const std::vector<std::uint8_t>& bytes) {
  if (reading == Reading::too_much) return fmt::format("holds more than the {} bytes allowed", limits.answer);
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (reading == Reading::too_long || signal == SIGXCPU || signal == SIGKILL) {
    return fmt::format(
        "reading it took more than {} s of processor time and was stopped; the file is damaged or far "
        "too complex. Export it again, or in another format",
        limits.cpu_seconds);
  }
  if (signal == 0 && WEXITSTATUS(status) == kOutOfMemory) {
    return fmt::format(
        "reading it needs more than {} MiB of memory; the file is damaged or far too complex. Export it "
        "again, or in another format",
        limits.memory >> 20);
  }
  if (signal == 0 && WEXITSTATUS(status) == kRefused && !bytes.empty()) {
    return printable(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                     kLongestMessage);
  }
  const std::string how =
      signal != 0 ? fmt::format("signal {}", signal) : fmt::format("status {}", WEXITSTATUS(status));
  return fmt::format(
      "the reader of this format crashed on it ({}); the file is damaged. Export it again, or in another "
      "format",
      how);
}

}  // namespace

std::vector<std::uint8_t> run_in_child(const std::string& subject, const ChildLimits& limits,
                                       const std::function<std::vector<std::uint8_t>()>& work) {
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) {
    throw Error(ExitCode::resources, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  const pid_t child = ::fork();
  if (child < 0) {
    const int reason = errno;
    ::close(pipe[0]);
    ::close(pipe[1]);
    throw Error(ExitCode::resources, fmt::format("cannot start a process: {}", std::strerror(reason)));
  }
  if (child == 0) {
    ::close(pipe[0]);
    run_child(pipe[1], limits, work);
  }
  ::close(pipe[1]);
  std::vector<std::uint8_t> bytes;
  const Reading reading = read_answer(pipe[0], limits, bytes);
  ::close(pipe[0]);
  const int status = reap(child, reading != Reading::complete);
  if (reading == Reading::complete && WIFEXITED(status) && WEXITSTATUS(status) == kAnswered) return bytes;
  throw Error(ExitCode::input, subject + ": " + what_went_wrong(reading, status, limits, bytes));
}

}  // namespace firn
