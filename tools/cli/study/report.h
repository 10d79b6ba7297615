// What a study leaves behind: study.csv, study.json, and study.html, which shows them.
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "tools/cli/study/front.h"
#include "tools/cli/study/runs.h"
#include "tools/cli/study/truth.h"

namespace firn {

/// The errors that the table of seconds to reach them has.
inline constexpr std::array<double, 4> kReachedErrors = {0.1, 0.05, 0.01, 0.001};

/// study.json: see tools/study/README.md.
nlohmann::ordered_json study_json(const StudyDescription& study, const Truth& truth, double time,
                                  const StudyRecords& runs);

/// One line a run.
std::string study_csv(const nlohmann::ordered_json& study);
/// The page with everything it needs in it.
std::string study_page(const nlohmann::ordered_json& study);

/// The front and the seconds to reach an error, as text.
std::string study_summary(const nlohmann::ordered_json& study, std::string_view quantity);

/// "cell_size 0.05, kernel quadratic": the settings that the study varies.
std::string settings_text(const nlohmann::ordered_json& study, const nlohmann::ordered_json& run);

}  // namespace firn
