#include "engine/output/output_folder.h"

#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "engine/base/nearest_name.h"
#include "engine/output/checked_file.h"
#include "engine/output/point_cache.h"
#include "engine/output/quantities.h"

namespace firn {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = ".firn.lock";

std::string shown(const fs::path& path) {
  return printable(path.string(), 1024);
}

fs::path lock_file(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  // An existing file at that place is also reported here, as "Not a directory" or "File exists".
  if (error || !fs::is_directory(folder, error)) {
    throw system_error(ExitCode::environment, "make the folder", folder, error ? error.value() : ENOTDIR);
  }
  return folder / kLockName;
}

std::string describe_this_process() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '?';
  return fmt::format("host {}, process {}, started {:%Y-%m-%d %H:%M:%S %z}", host.data(), ::getpid(),
                     fmt::localtime(std::time(nullptr)));
}

std::string holder(const fs::path& lock) {
  std::ifstream in(lock);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  return text.empty() ? "a process that is just starting" : printable(text.substr(0, text.find('\n')), 400);
}

// "particles.", four digits or more, ".vdb".
bool is_frame(std::string_view name) {
  constexpr std::string_view prefix = "particles.", suffix = ".vdb";
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
  name.remove_prefix(prefix.size());
  if (name.size() < 4 + suffix.size()) return false;
  name.remove_suffix(suffix.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

bool belongs_to_a_run(std::string_view name) {
  constexpr std::string_view hidden = ".", partial = ".partial";  // as CheckedFile names them
  if (name.size() > hidden.size() + partial.size() && name.starts_with(hidden) && name.ends_with(partial)) {
    name.remove_prefix(hidden.size());
    name.remove_suffix(partial.size());
  }
  return is_frame(name) || name == "diagnostics.csv" || name == "run.json";
}

template <class Predicate>
std::vector<fs::path> entries(const fs::path& folder, const Predicate& wanted) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (wanted(it->path().filename().string())) out.push_back(it->path());
  }
  if (error) throw system_error(ExitCode::environment, "list", folder, error.value());
  return out;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& path, const OutputFolderSettings& settings)
    : path_(path), lock_(lock_file(path), O_RDWR | O_CREAT, 0666, ExitCode::environment) {
  take_lock();
  const auto frames = entries(path_, is_frame);
  if (!frames.empty() && !settings.overwrite) {
    throw Error(ExitCode::in_use,
                fmt::format("{} already holds {} frame{} of an earlier run; choose another folder with "
                            "--out, or replace them with --overwrite",
                            shown(path_), frames.size(), frames.size() == 1 ? "" : "s"));
  }
  const auto free = free_bytes(path_);
  if (free && *free < settings.expected_bytes) {
    warning_ = fmt::format("{} has {} free, and the run is expected to write about {}", shown(path_),
                           readable_bytes(*free), readable_bytes(settings.expected_bytes));
  }
}

void OutputFolder::take_lock() {
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK) throw system_error(ExitCode::environment, "lock", path_, errno);
    throw Error(ExitCode::in_use,
                fmt::format("{} is being written to by another run ({}); wait for it, or choose another "
                            "folder with --out",
                            shown(path_), holder(path_ / kLockName)));
  }
  // Also shows whether the file system takes a write at all.
  const std::string text = describe_this_process() + '\n';
  try {
    lock_.truncate(0);
    lock_.write_at(text.data(), text.size(), 0, text.size());
    lock_.sync();
  } catch (const Error& error) {
    throw Error(ExitCode::environment, error.what());
  }
}

fs::path OutputFolder::frame_file(int frame) const {
  return path_ / point_cache_name(frame);
}

void OutputFolder::remove_earlier_run() {
  for (const fs::path& file : entries(path_, belongs_to_a_run)) {
    if (::unlink(file.c_str()) != 0 && errno != ENOENT)
      throw system_error(ExitCode::io, "remove", file, errno);
  }
  sync_folder(path_);
}

}  // namespace firn
