#include "engine/shapes/child_process.h"

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <unistd.h>

#include "engine/base/error.h"

using namespace firn;
using Bytes = std::vector<std::uint8_t>;

namespace {

const ChildLimits kLimits{std::uint64_t{64} << 20, 1, 1 << 20};

std::string failure(const std::function<Bytes()>& work) {
  try {
    run_in_child("'x'", kLimits, work);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::input);
    return error.what();
  }
  return "no error";
}

// Hidden from the optimiser, which would otherwise drop an endless loop or an unused allocation.
volatile std::uint64_t sink = 0;

}  // namespace

TEST_CASE("a child process returns its answer whole") {
  Bytes expected(700'001);
  for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<std::uint8_t>(i * 7);
  CHECK(run_in_child("'x'", kLimits, [&] { return expected; }) == expected);
  CHECK(run_in_child("'x'", kLimits, [] { return Bytes{}; }).empty());
}

TEST_CASE("what goes wrong in a child process becomes an error about the file") {
  using Catch::Matchers::StartsWith;
  CHECK(failure([]() -> Bytes { throw Error(ExitCode::input, "bad face"); }) == "'x': bad face");
  CHECK(failure([]() -> Bytes { throw std::runtime_error("line\n\x1b[2J"); }) == "'x': line\\x0a\\x1b[2J");
  CHECK_THAT(failure([]() -> Bytes { std::abort(); }),
             StartsWith("'x': the reader of this format crashed on it (signal 6); the file is damaged"));
  CHECK_THAT(failure([]() -> Bytes {
               std::raise(SIGSEGV);
               return {};
             }),
             StartsWith("'x': the reader of this format crashed"));
  CHECK_THAT(failure([]() -> Bytes { ::_exit(3); }),
             StartsWith("'x': the reader of this format crashed on it (status 3)"));
  CHECK_THAT(failure([]() -> Bytes {
               while (true) sink = sink + 1;
             }),
             StartsWith("'x': reading it took more than 1 s of processor time"));
  CHECK(failure([] { return Bytes((1 << 20) + 1); }) == "'x': holds more than the 1048576 bytes allowed");
}

TEST_CASE("a child process cannot open files or write to the terminal") {
  CHECK(failure([]() -> Bytes {
          if (::open("/etc/hostname", O_RDONLY) >= 0) return {};
          throw std::runtime_error("refused");
        }) == "'x': refused");
  const ChildLimits open{kLimits.memory, 1, 1 << 20, true};
  CHECK(run_in_child("'x'", open, [] { return Bytes(::open("/dev/null", O_RDONLY) >= 0 ? 1 : 0); }).size() ==
        1);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a child process that wants too much memory is an error about the file") {
  CHECK_THAT(failure([]() -> Bytes {
               std::vector<std::uint8_t> much(std::size_t{1} << 30, 1);
               sink = much[sink];
               return {};
             }),
             Catch::Matchers::StartsWith("'x': reading it needs more than 64 MiB of memory"));
}
#endif
