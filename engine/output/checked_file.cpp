#include "engine/output/checked_file.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <streambuf>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "engine/base/nearest_name.h"
#include "engine/output/posix_file.h"

namespace firn {

// Collects small writes into large ones. The put area starts at file offset `start_`.
class CheckedFile::Buffer : public std::streambuf {
 public:
  Buffer(const std::filesystem::path& path, std::uint64_t expected_bytes)
      : path_(path),
        file_(path, O_WRONLY | O_CREAT | O_TRUNC, 0666),
        expected_(expected_bytes),
        storage_(kBytes) {
    reset_put_area();
  }

  void flush() {
    if (failure_) throw Error(*failure_);
    const auto pending = static_cast<std::size_t>(pptr() - pbase());
    write_out(pbase(), pending);
    reset_put_area();
  }

  std::uint64_t finish() {
    flush();
    file_.sync();
    if (file_.size() != end_) {
      throw Error(ExitCode::io,
                  fmt::format("{} holds {} bytes where {} were written; check the disk or network",
                              printable(path_.string(), 1024), file_.size(), end_));
    }
    file_.close();
    return end_;
  }

 protected:
  int_type overflow(int_type c) override {
    flush();
    if (!traits_type::eq_int_type(c, traits_type::eof())) {
      *pptr() = traits_type::to_char_type(c);
      pbump(1);
    }
    return traits_type::not_eof(c);
  }

  std::streamsize xsputn(const char* data, std::streamsize size) override {
    if (size > epptr() - pptr()) flush();
    if (size > epptr() - pptr()) {
      write_out(data, static_cast<std::size_t>(size));
    } else {
      std::memcpy(pptr(), data, static_cast<std::size_t>(size));
      pbump(static_cast<int>(size));
    }
    return size;
  }

  int sync() override {
    flush();
    return 0;
  }

  pos_type seekoff(off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode) override {
    const std::uint64_t here = start_ + static_cast<std::uint64_t>(pptr() - pbase());
    if (direction == std::ios_base::cur && offset == 0) return pos_type(static_cast<off_type>(here));
    flush();
    const std::uint64_t base = direction == std::ios_base::beg   ? 0
                               : direction == std::ios_base::cur ? here
                                                                 : end_;
    const off_type target = static_cast<off_type>(base) + offset;
    if (target < 0) return pos_type(off_type(-1));
    start_ = static_cast<std::uint64_t>(target);
    return pos_type(target);
  }

  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

 private:
  // Few system calls, and small beside a frame.
  static constexpr std::size_t kBytes = std::size_t{1} << 20;

  void reset_put_area() { setp(storage_.data(), storage_.data() + storage_.size()); }

  // The first failure is kept: a library in between may swallow the exception and carry on.
  void write_out(const char* data, std::size_t size) {
    try {
      file_.write_at(data, size, start_, std::max(expected_, start_ + size));
    } catch (const Error& error) {
      failure_ = error;
      throw;
    }
    start_ += size;
    end_ = std::max(end_, start_);
  }

  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t expected_;
  std::vector<char> storage_;
  std::uint64_t start_ = 0, end_ = 0;
  std::optional<Error> failure_;
};

CheckedFile::CheckedFile(const std::filesystem::path& target, std::uint64_t expected_bytes)
    : target_(target),
      temporary_(temporary_name(target)),
      buffer_(std::make_unique<Buffer>(temporary_, expected_bytes)),
      stream_(buffer_.get()) {
  // With these bits the stream passes on what the buffer throws instead of going silent.
  stream_.exceptions(std::ios::badbit | std::ios::failbit);
}

CheckedFile::~CheckedFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

std::ostream& CheckedFile::stream() {
  return stream_;
}

std::uint64_t CheckedFile::commit() {
  const std::uint64_t bytes = buffer_->finish();
  rename_file(temporary_, target_);
  committed_ = true;
  sync_folder(target_.parent_path());
  return bytes;
}

std::filesystem::path CheckedFile::temporary_name(const std::filesystem::path& target) {
  return target.parent_path() / fmt::format(".{}.partial", target.filename().string());
}

}  // namespace firn
