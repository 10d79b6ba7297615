#include "tools/cli/study/run_store.h"

#include <fstream>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/output/checked_file.h"
#include "tools/cli/version.h"

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

/// What made a result: built anew, a program may be another one, and another one's seconds are not its own.
std::string program() {
  const auto built = std::filesystem::last_write_time("/proc/self/exe").time_since_epoch().count();
  return fmt::format("{} {}", kVersion, built);
}

}  // namespace

RunStore::RunStore(const std::filesystem::path& folder, std::string truth)
    : folder_(folder / "runs"), truth_(std::move(truth)) {
  std::error_code failed;
  std::filesystem::create_directories(folder_, failed);
  if (failed) throw Error(ExitCode::environment, fmt::format("{}: {}", folder_.string(), failed.message()));
}

std::filesystem::path RunStore::file(const StudyRun& run, std::string_view extension) const {
  return folder_ / fmt::format("{:016x}.{}", run.key, extension);
}

Json RunStore::find(const StudyRun& run) const {
  std::ifstream in(file(run, "json"));
  const Json record = Json::parse(in, nullptr, false);
  const auto is = [&](const char* key, const std::string& value) {
    return record.contains(key) && record[key] == value;
  };
  return is("program", program()) && is("truth", truth_) ? record["run"] : Json(nullptr);
}

void RunStore::keep(const StudyRun& run, const Json& record) const {
  write_text(file(run, "json"), json_text({{"program", program()}, {"truth", truth_}, {"run", record}}));
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  CheckedFile file(path, text.size());
  file.stream() << text;
  file.commit();
}

std::string json_text(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace firn
