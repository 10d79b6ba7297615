#include "engine/output/posix_file.h"

#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "engine/base/nearest_name.h"
#include "engine/output/quantities.h"

namespace firn {
namespace {

// A call that a signal interrupted is simply made again.
template <class Call>
auto retry(Call call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

const char* next_step(int error_number) {
  switch (error_number) {
    case ENOSPC:
      return "free some space there, or choose another folder with --out";
    case EDQUOT:
      return "free some of your quota there, or choose another folder with --out";
    case EFBIG:
      return "raise the limit on the size of a file (ulimit -f), or write to a file system that allows "
             "larger files";
    case EROFS:
      return "the file system is read-only: choose another folder with --out";
    case EACCES:
    case EPERM:
      return "make the folder writable for you, or choose another with --out";
    case EMFILE:
    case ENFILE:
      return "raise the limit on open files (ulimit -n)";
    case EIO:
      return "the disk or network reports a fault: check the system log, or choose another folder with --out";
    case ENAMETOOLONG:
      return "choose a shorter folder name with --out";
    default:
      return "check the folder, or choose another with --out";
  }
}

}  // namespace

std::optional<std::uint64_t> free_bytes(const std::filesystem::path& path) {
  struct statvfs info {};
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  if (statvfs(path.c_str(), &info) != 0 && statvfs(folder.c_str(), &info) != 0) return std::nullopt;
  return std::uint64_t{info.f_bavail} * info.f_frsize;
}

Error system_error(ExitCode code, const std::string& action, const std::filesystem::path& path,
                   int error_number, std::uint64_t needed) {
  std::string room;
  if (const auto free = free_bytes(path)) {
    room = needed > 0 ? fmt::format(" (needed: {}, free: {})", readable_bytes(needed), readable_bytes(*free))
                      : fmt::format(" (free: {})", readable_bytes(*free));
  }
  return Error(code, fmt::format("cannot {} {}: {}{}; {}", action, printable(path.string(), 1024),
                                 std::strerror(error_number), room, next_step(error_number)));
}

Descriptor::Descriptor(const std::filesystem::path& path, int flags, unsigned mode, ExitCode code_on_failure)
    : path_(path), fd_(retry([&] { return ::open(path.c_str(), flags | O_CLOEXEC, mode); })) {
  if (fd_ < 0) throw system_error(code_on_failure, "open", path_, errno);
}

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

void Descriptor::write_at(const char* data, std::size_t size, std::uint64_t offset,
                          std::uint64_t needed) const {
  while (size > 0) {
    const ssize_t written = retry([&] { return ::pwrite(fd_, data, size, static_cast<off_t>(offset)); });
    // A file system that accepts nothing without saying why would keep the loop going for ever.
    if (written <= 0) throw system_error(ExitCode::io, "write", path_, written < 0 ? errno : EIO, needed);
    data += written;
    size -= static_cast<std::size_t>(written);
    offset += static_cast<std::uint64_t>(written);
  }
}

void Descriptor::sync() const {
  if (retry([&] { return ::fsync(fd_); }) != 0) throw system_error(ExitCode::io, "sync", path_, errno);
}

std::uint64_t Descriptor::size() const {
  struct stat info {};
  if (::fstat(fd_, &info) != 0) throw system_error(ExitCode::io, "examine", path_, errno);
  return static_cast<std::uint64_t>(info.st_size);
}

void Descriptor::truncate(std::uint64_t size) const {
  if (retry([&] { return ::ftruncate(fd_, static_cast<off_t>(size)); }) != 0) {
    throw system_error(ExitCode::io, "cut", path_, errno);
  }
}

void Descriptor::close() {
  const int fd = fd_;
  fd_ = -1;  // Linux frees the descriptor even when close() fails: never close it a second time.
  if (::close(fd) != 0 && errno != EINTR) throw system_error(ExitCode::io, "close", path_, errno);
}

void sync_folder(const std::filesystem::path& folder) {
  const Descriptor descriptor(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY, 0);
  descriptor.sync();
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (retry([&] { return ::rename(from.c_str(), to.c_str()); }) != 0) {
    throw system_error(ExitCode::io, "finish", to, errno);
  }
}

void ignore_file_size_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace firn
