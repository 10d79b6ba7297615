#include "engine/output/output_folder.h"

#include <csignal>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/base/error.h"
#include "tests/engine/output/temporary_folder.h"

namespace firn {
namespace {

using testing::names_in;
using testing::TemporaryFolder;
using testing::write_file;

std::string refusal(ExitCode expected, const std::filesystem::path& path,
                    const OutputFolderSettings& settings = {}) {
  try {
    const OutputFolder folder(path, settings);
  } catch (const Error& error) {
    CHECK(error.code() == expected);
    return error.what();
  }
  FAIL("the folder was accepted");
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("an output folder is made with its parents") {
  const TemporaryFolder temporary;
  const OutputFolder folder(temporary.path() / "a" / "b", {});
  CHECK(folder.frame_file(7) == temporary.path() / "a" / "b" / "particles.0007.vdb");
  CHECK(folder.warning().empty());
}

TEST_CASE("an output folder that cannot be made is refused with the reason") {
  const TemporaryFolder temporary;
  write_file(temporary.path() / "file", "");
  for (const auto& path : {temporary.path() / "file", temporary.path() / "file" / "below"}) {
    const std::string message = refusal(ExitCode::environment, path);
    CHECK(contains(message, path.string()));
    CHECK(contains(message, "Not a directory"));
  }
}

TEST_CASE("a user without permission is told so") {
  const TemporaryFolder temporary;
  std::filesystem::permissions(temporary.path(),
                               std::filesystem::perms::owner_read | std::filesystem::perms::others_read |
                                   std::filesystem::perms::owner_exec | std::filesystem::perms::others_exec);
  const pid_t child = fork();  // root may write anywhere, so become someone else
  REQUIRE(child >= 0);
  if (child == 0) {
    if (getuid() == 0 && setuid(65534) != 0) _exit(2);
    try {
      const OutputFolder folder(temporary.path() / "new", {});
    } catch (const Error& error) {
      _exit(error.code() == ExitCode::environment && contains(error.what(), "Permission denied") ? 0 : 1);
    }
    _exit(1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("two runs cannot write to one folder") {
  const TemporaryFolder temporary;
  {
    const OutputFolder first(temporary.path(), {});
    const std::string message = refusal(ExitCode::in_use, temporary.path());
    CHECK(contains(message, "process " + std::to_string(getpid())));
    CHECK(contains(message, "host "));
    CHECK(contains(message, "started 20"));
  }
  const OutputFolder second(temporary.path(), {});
}

TEST_CASE("a killed run leaves no lock behind") {
  const TemporaryFolder temporary;
  int ready[2];
  REQUIRE(pipe(ready) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const OutputFolder folder(temporary.path(), {});
    if (write(ready[1], "x", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  CHECK(contains(refusal(ExitCode::in_use, temporary.path()), "process " + std::to_string(child)));
  kill(child, SIGKILL);
  REQUIRE(waitpid(child, nullptr, 0) == child);
  close(ready[0]);
  close(ready[1]);
  const OutputFolder folder(temporary.path(), {});
}

TEST_CASE("frames of an earlier run are kept unless they may be overwritten") {
  const TemporaryFolder temporary;
  for (const char* name :
       {"particles.0001.vdb", "particles.0250.vdb", ".particles.0251.vdb.partial", "diagnostics.csv",
        "run.json", ".partial", "notes.txt", "particles.1.vdb", "my particles.0001.vdb"}) {
    write_file(temporary.path() / name, "earlier");
  }
  const std::string message = refusal(ExitCode::in_use, temporary.path());
  CHECK(contains(message, "holds 2 frames"));
  CHECK(contains(message, "--overwrite"));

  OutputFolder folder(temporary.path(), {.overwrite = true});
  CHECK(names_in(temporary.path()).size() == 10);  // the lock is new, nothing is gone yet
  folder.remove_earlier_run();
  CHECK(names_in(temporary.path()) == std::vector<std::string>{".firn.lock", ".partial",
                                                               "my particles.0001.vdb", "notes.txt",
                                                               "particles.1.vdb"});
}

TEST_CASE("too little free space is a warning that names both sizes") {
  const TemporaryFolder temporary;
  const OutputFolder folder(temporary.path(), {.expected_bytes = 8'000'000'000'000'000'000});
  CHECK(contains(folder.warning(), "expected to write about 8.0 EB"));
  CHECK(contains(folder.warning(), " free"));
}

}  // namespace firn
