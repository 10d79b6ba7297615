// Which runs of a study are worth their time.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace firn {

using StudyRecords = std::vector<nlohmann::ordered_json>;  // as in study.json's "runs"

/// The relative L2 error; empty unless the run finished and has one.
std::optional<double> error_of(const nlohmann::ordered_json& run, std::string_view quantity);
/// Median, s.
double seconds_of(const nlohmann::ordered_json& run);

/// Runs that no other one beats in both error and seconds, by seconds.
std::vector<const nlohmann::ordered_json*> pareto_front(const StudyRecords& runs, std::string_view quantity);

/// The quickest run with at most that error; null when there is none.
const nlohmann::ordered_json* cheapest(const StudyRecords& runs, std::string_view quantity, double error);
/// The run of the least error within that time; null when there is none.
const nlohmann::ordered_json* most_accurate(const StudyRecords& runs, std::string_view quantity,
                                            double seconds);

}  // namespace firn
