#include "tools/cli/child_program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

constexpr std::size_t kMostOutput = std::size_t{1} << 20;

[[noreturn]] void refuse(const std::string& program, std::string_view why) {
  throw Error(ExitCode::input, fmt::format("{}: {}", printable(program, 4096), why));
}

/// A pipe whose ends close themselves, and by themselves in a child.
class Pipe {
 public:
  Pipe() {
    if (::pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw Error(ExitCode::resources, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  }
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() { close_end(1); }

 private:
  void close_end(std::size_t k) {
    if (ends_[k] >= 0) ::close(ends_[k]);
    ends_[k] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

pid_t start(const std::string& program, const std::vector<std::string>& arguments, const Pipe& out,
            const Pipe& error) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.writing(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, error.writing(), STDERR_FILENO);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, program.c_str(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) refuse(program, fmt::format("cannot be started: {}", std::strerror(failed)));
  return child;
}

/// Reads both to their ends, side by side: a child that fills one pipe waits. False when it is too much.
bool read_both(const Pipe& out, const Pipe& error, ProgramAnswer& answer) {
  std::array<pollfd, 2> waiting{{{out.reading(), POLLIN, 0}, {error.reading(), POLLIN, 0}}};
  std::array<std::string*, 2> texts{&answer.out, &answer.error};
  std::array<char, 4096> piece;
  while (waiting[0].fd >= 0 || waiting[1].fd >= 0) {
    if (::poll(waiting.data(), waiting.size(), -1) < 0) continue;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      if (waiting[k].fd < 0 || waiting[k].revents == 0) continue;
      const ssize_t n = ::read(waiting[k].fd, piece.data(), piece.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) {
        waiting[k].fd = -1;  // poll passes over it
        continue;
      }
      texts[k]->append(piece.data(), static_cast<std::size_t>(n));
      if (texts[k]->size() > kMostOutput) return false;
    }
  }
  return true;
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ProgramAnswer run_program(const std::string& program, const std::vector<std::string>& arguments) {
  Pipe out, error;
  const pid_t child = start(program, arguments, out, error);
  // Or reading would never end.
  out.close_writing();
  error.close_writing();
  ProgramAnswer answer;
  const bool complete = read_both(out, error, answer);
  if (!complete) ::kill(child, SIGKILL);
  answer.status = wait_for(child);
  if (!complete) refuse(program, fmt::format("prints more than {} bytes", kMostOutput));
  return answer;
}

}  // namespace firn
