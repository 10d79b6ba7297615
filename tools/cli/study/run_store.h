// Where the results of single runs are kept, so that a study that was stopped goes on where it was.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "tools/cli/study/runs.h"

namespace firn {

class RunStore {
 public:
  /// In `folder`/runs, made if need be. `truth`: what the errors in it are taken against. Throws
  /// Error{environment}.
  RunStore(const std::filesystem::path& folder, std::string truth);

  /// Named by all that the run's results depend on but the program and the truth.
  std::filesystem::path file(const StudyRun& run, std::string_view extension) const;

  /// Null when the run was not made, or by another program or for another truth.
  nlohmann::ordered_json find(const StudyRun& run) const;
  /// Throws Error{io}.
  void keep(const StudyRun& run, const nlohmann::ordered_json& record) const;

 private:
  std::filesystem::path folder_;
  std::string truth_;
};

/// Writes a whole file, or none. Throws Error{io}.
void write_text(const std::filesystem::path& path, const std::string& text);

/// Bytes that are no UTF-8, as in a file's name, are replaced.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace firn
