// `firn study`: what accuracy costs in time, for any scene and any settings.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

namespace firn {

struct StudyOptions {
  std::filesystem::path study, out;  // out: empty for out/NAME
  bool list = false;                 // only the runs, with their projected times
  std::string quantity = "displacement";
  std::optional<std::string> error, budget;  // "1%", "10m": print the cheapest settings
};

int run_study(const StudyOptions& options, std::ostream& out);

}  // namespace firn
