// Real limits in place of injected ones: a small file system that fills up, a limit on file size, a read-only
// folder.
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>

#include <catch2/catch.hpp>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "engine/output/checked_file.h"
#include "engine/output/output_folder.h"
#include "engine/output/point_cache.h"
#include "tests/engine/output/temporary_folder.h"
#include "tests/support/sample_frame.h"

namespace firn {
namespace {

using testing::names_in;
using testing::read_file;
using testing::SampleFrame;
using testing::TemporaryFolder;

const PointCacheSettings kSettings{0.1, 24, "test"};

// A file system of 4 MB at a folder, while it lives; mounted() is false where that is not permitted.
class SmallFileSystem {
 public:
  explicit SmallFileSystem(const std::filesystem::path& folder) : folder_(folder) {
    std::filesystem::create_directory(folder);
    mounted_ = mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=4m") == 0;
    if (!mounted_) std::cerr << "SKIPPED: mounting a small file system is not permitted here\n";
  }
  ~SmallFileSystem() {
    if (mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallFileSystem(const SmallFileSystem&) = delete;
  SmallFileSystem& operator=(const SmallFileSystem&) = delete;
  bool mounted() const { return mounted_; }
  void make_read_only() const { mount(nullptr, folder_.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr); }

 private:
  std::filesystem::path folder_;
  bool mounted_;
};

struct Failure {
  ExitCode code = ExitCode::ok;
  std::string message;
};

Failure attempt(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  return {};
}

void check_names_all(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    CAPTURE(message, part);
    CHECK(message.find(part) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a full disk is reported and earlier frames stay whole") {
  const TemporaryFolder folder;
  const auto disk = folder.path() / "disk";
  const SmallFileSystem small(disk);
  if (!small.mounted()) return;
  const SampleFrame sample(20'000);
  std::vector<std::string> written;
  Failure failure;
  while (failure.code == ExitCode::ok && written.size() < 100) {
    const auto file = disk / point_cache_name(static_cast<int>(written.size()) + 1);
    failure = attempt([&] { write_point_cache(file, sample.view(), kSettings); });
    if (failure.code == ExitCode::ok) written.push_back(read_file(file));
  }
  CHECK(failure.code == ExitCode::io);
  check_names_all(failure.message,
                  {"No space left on device", "particles.000", "needed: ", "free: ", "free some space"});
  REQUIRE(written.size() >= 2);
  CHECK(names_in(disk).size() == written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    CHECK(read_file(disk / point_cache_name(static_cast<int>(i) + 1)) == written[i]);
  }
}

TEST_CASE("a disk without room for anything stops the run before it starts") {
  const TemporaryFolder folder;
  const auto disk = folder.path() / "disk";
  const SmallFileSystem small(disk);
  if (!small.mounted()) return;
  testing::write_file(disk / "ballast", std::string(5 << 20, 'x'));
  const Failure failure = attempt([&] { const OutputFolder output(disk, {}); });
  CHECK(failure.code == ExitCode::environment);
  check_names_all(failure.message, {"No space left on device", "free: 0 B"});
}

TEST_CASE("a read-only file system stops the run before it starts") {
  const TemporaryFolder folder;
  const auto disk = folder.path() / "disk";
  const SmallFileSystem small(disk);
  if (!small.mounted()) return;
  small.make_read_only();
  for (const auto& path : {disk, disk / "new"}) {
    const Failure failure = attempt([&] { const OutputFolder output(path, {}); });
    CHECK(failure.code == ExitCode::environment);
    check_names_all(failure.message,
                    {path.string(), "Read-only file system", "choose another folder with --out"});
  }
}

TEST_CASE("a limit on file size is reported instead of killing the program") {
  const TemporaryFolder folder;
  const SampleFrame sample(20'000);
  const auto file = folder.path() / "particles.0001.vdb";
  // In a child, since the limit would hold for the whole test program.
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ignore_file_size_signals();
    const rlimit limit{300'000, 300'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    Failure failure = attempt([&] {
      CheckedFile out(file);
      out.stream() << std::string(2'000'000, 'x');
      out.commit();
    });
    const bool right = failure.code == ExitCode::io &&
                       failure.message.find("File too large") != std::string::npos &&
                       failure.message.find("ulimit -f") != std::string::npos;
    _exit(right ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(names_in(folder.path()).empty());
}

}  // namespace firn
