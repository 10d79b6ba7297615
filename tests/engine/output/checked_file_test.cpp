#include "engine/output/checked_file.h"

#include <cerrno>
#include <cstring>
#include <string>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/output/diagnostics.h"
#include "engine/output/point_cache.h"
#include "tests/engine/output/fault_injection.h"
#include "tests/engine/output/temporary_folder.h"
#include "tests/support/sample_frame.h"

namespace firn {
namespace {

using testing::FaultInjection;
using testing::kShortWrite;
using testing::names_in;
using testing::read_file;
using testing::SampleFrame;
using testing::TemporaryFolder;
using testing::write_file;

// Writes a file of several buffers; the message of the error, or "".
std::string write_checked(const std::filesystem::path& file, const std::string& text) {
  try {
    CheckedFile out(file, text.size());
    out.stream() << text;
    const std::uint64_t bytes = out.commit();
    CHECK(bytes == text.size());
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::io);
    return error.what();
  }
  return "";
}

std::string long_text() {
  std::string out;
  for (int i = 0; i < 400'000; ++i) out += std::to_string(i) + ' ';
  return out;
}

}  // namespace

TEST_CASE("a checked file appears when it is committed and not before") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.bin";
  {
    CheckedFile out(file);
    out.stream() << "half";
    out.stream().flush();
    CHECK(names_in(folder.path()) == std::vector<std::string>{".a.bin.partial"});
  }
  CHECK(names_in(folder.path()).empty());
  CHECK(write_checked(file, long_text()).empty());
  CHECK(names_in(folder.path()) == std::vector<std::string>{"a.bin"});
  CHECK(read_file(file) == long_text());
}

TEST_CASE("a checked file can seek back and forth") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.bin";
  const std::string filler(3 << 20, 'x');
  CheckedFile out(file);
  auto& stream = out.stream();
  stream << "....head" << filler;
  CHECK(stream.tellp() == std::streamoff(8 + filler.size()));
  stream.seekp(0);
  stream << "seen";
  stream.seekp(-1, std::ios::end);
  stream << "END";
  stream.seekp(4);
  stream << "H";
  CHECK(out.commit() == 8 + filler.size() + 2);
  CHECK(read_file(file) == "seenHead" + filler.substr(1) + "END");
}

TEST_CASE("every failing system call of a file is reported and the file before it stays whole") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.bin";
  const std::string text = long_text();
  for (const int error_number : {ENOSPC, EIO, EDQUOT, EROFS, EFBIG}) {
    for (const bool persistent : {false, true}) {
      bool fired = true;
      int call = 1;
      for (; fired; ++call) {
        write_file(file, "earlier");
        const FaultInjection fault(call, error_number, persistent);
        const std::string message = write_checked(file, text);
        fired = fault.fired();
        CAPTURE(call, message);
        REQUIRE(message.empty() != fired);
        REQUIRE(names_in(folder.path()) == std::vector<std::string>{"a.bin"});
        const std::string now = read_file(file);
        // After the rename only the folder's sync is left to fail: then the new file is there, whole.
        REQUIRE((now == "earlier" || now == text));
        if (!fired) break;
        REQUIRE(message.find(folder.path().string()) != std::string::npos);
        REQUIRE(message.find(std::strerror(error_number)) != std::string::npos);
        REQUIRE(message.find("free: ") != std::string::npos);
        REQUIRE(message.find("; ") != std::string::npos);
      }
      CHECK(call >= 5);  // one write or more, the file's sync, the rename, the folder's sync
    }
  }
}

TEST_CASE("interrupted calls and short writes are continued") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.bin";
  const std::string text = long_text();
  for (const int kind : {EINTR, kShortWrite}) {
    bool fired = true;
    for (int call = 1; fired; ++call) {
      const FaultInjection fault(call, kind);
      CAPTURE(kind, call);
      REQUIRE(write_checked(file, text).empty());
      REQUIRE(read_file(file) == text);
      fired = fault.fired();
    }
  }
}

TEST_CASE("a failed write that someone in between kept quiet about is reported at the end") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "a.bin";
  CheckedFile out(file);
  out.stream().exceptions(std::ios::goodbit);
  {
    const FaultInjection fault(1, ENOSPC);
    out.stream() << long_text();
    CHECK(fault.fired());
  }
  CHECK_THROWS_WITH(out.commit(), Catch::Contains("No space left on device"));
  CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("a failed write inside OpenVDB reaches the caller") {
  const TemporaryFolder folder;
  const SampleFrame sample(50'000);  // several buffers
  const auto file = folder.path() / "particles.0001.vdb";
  bool fired = true;
  int call = 1;
  for (; fired; ++call) {
    const FaultInjection fault(call, ENOSPC, true);
    ExitCode code = ExitCode::ok;
    try {
      write_point_cache(file, sample.view(), {0.1, 24, "test"});
    } catch (const Error& error) {
      code = error.code();
    }
    fired = fault.fired();
    CAPTURE(call);
    REQUIRE(code == (fired ? ExitCode::io : ExitCode::ok));
    REQUIRE_FALSE(std::filesystem::exists(CheckedFile::temporary_name(file)));
  }
  CHECK(call >= 7);
}

TEST_CASE("a diagnostics row is written whole or not at all") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "diagnostics.csv";
  const FrameView frame = SampleFrame(0).view();
  Diagnostics diagnostics(file, {"cuts"});
  diagnostics.append(frame);
  const std::string before = read_file(file);
  for (const int call : {1, 2}) {
    const FaultInjection fault(call, ENOSPC);
    CHECK_THROWS_AS(diagnostics.append(frame), Error);
    CHECK(read_file(file) == before);
  }
  {
    const FaultInjection fault(1, kShortWrite);
    diagnostics.append(frame);
  }
  CHECK(read_file(file) == before + before.substr(before.find('\n') + 1));
}

}  // namespace firn
