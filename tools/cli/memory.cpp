#include "tools/cli/memory.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <sys/resource.h>

#include "engine/base/error.h"
#include "engine/base/nearest_name.h"

namespace firn {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t memory_available_to_system() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  std::uint64_t kib = 0;
  while (file >> key >> kib) {
    std::getline(file, unit);
    if (key == "MemAvailable:") return kib * 1024;
  }
  return kUnlimited;
}

// Limit less use of a control group; a file that is absent or says "max" limits nothing.
std::uint64_t left_in_group(const char* limit_file, const char* use_file) {
  std::uint64_t limit = 0, used = 0;
  std::ifstream limits(limit_file), use(use_file);
  if (!(limits >> limit) || !(use >> used)) return kUnlimited;
  return limit > used ? limit - used : 0;
}

}  // namespace

std::uint64_t available_memory() {
  std::uint64_t left = std::min({memory_available_to_system(),
                                 left_in_group("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
                                 left_in_group("/sys/fs/cgroup/memory/memory.limit_in_bytes",
                                               "/sys/fs/cgroup/memory/memory.usage_in_bytes")});
  rlimit address_space{};
  if (getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY)
    left = std::min<std::uint64_t>(left, address_space.rlim_cur);
  return left;
}

std::uint64_t parse_bytes(const std::string& text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  const std::string unit(rest, end);
  const std::string units = "KMGT";
  const std::size_t scale = unit.size() == 1 ? units.find(unit[0]) : std::string::npos;
  const unsigned shift = unit.empty() ? 0 : 10 * (static_cast<unsigned>(scale) + 1);
  const bool known = unit.empty() || scale != std::string::npos;
  if (error != std::errc() || !known || value == 0 || value > kUnlimited >> shift)
    throw Error(ExitCode::input,
                fmt::format("'{}' is not a size; expected a whole number with K, M, G or T, as in 8G",
                            printable(text)));
  return value << shift;
}

}  // namespace firn
