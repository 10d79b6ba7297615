#include "engine/shapes/file_bytes.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ExitCode::input, quoted(path) + ": " + why);
}

/// An open file that has passed the checks.
class CheckedFile {
 public:
  CheckedFile(const std::filesystem::path& path, std::uint64_t limit) : path_(path) {
    // Non-blocking, or opening a pipe without a writer would wait for ever.
    descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) refuse(errno == ENOENT ? "no such file" : std::strerror(errno));
    struct stat status;
    if (::fstat(descriptor_, &status) != 0) refuse(std::strerror(errno));
    if (S_ISDIR(status.st_mode)) refuse("is a folder, not a file");
    if (!S_ISREG(status.st_mode)) refuse("is a device or a pipe, not a file");
    if (status.st_size == 0) refuse("the file is empty");
    size_ = static_cast<std::uint64_t>(status.st_size);
    if (size_ > limit)
      refuse(fmt::format("has {} bytes, more than the {} this kind of file may have", size_, limit));
  }
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  ~CheckedFile() { close(); }

  std::uint64_t size() const { return size_; }

  std::vector<std::uint8_t> read() {
    std::vector<std::uint8_t> bytes(size_);
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t n = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) refuse(std::strerror(errno));
      if (n == 0) refuse("became shorter while it was read");
      done += static_cast<std::size_t>(n);
    }
    return bytes;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) {
    close();
    fail(path_, why);
  }
  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

  const std::filesystem::path& path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace

std::string quoted(const std::filesystem::path& path) {
  return fmt::format("'{}'", printable(path.string(), 300));
}

std::vector<std::uint8_t> read_regular_file(const std::filesystem::path& path, std::uint64_t limit) {
  return CheckedFile(path, limit).read();
}

std::uint64_t check_regular_file(const std::filesystem::path& path, std::uint64_t limit) {
  return CheckedFile(path, limit).size();
}

}  // namespace firn
