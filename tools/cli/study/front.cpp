#include "tools/cli/study/front.h"

#include <algorithm>

namespace firn {

using Json = nlohmann::ordered_json;

std::optional<double> error_of(const Json& run, std::string_view quantity) {
  if (run["state"] != "finished") return std::nullopt;
  const auto found = run["error"].find(quantity);
  if (found == run["error"].end() || (*found)["l2"].is_null()) return std::nullopt;
  return (*found)["l2"].get<double>();
}

double seconds_of(const Json& run) {
  return run["seconds"]["median"].get<double>();
}

std::vector<const Json*> pareto_front(const StudyRecords& runs, std::string_view quantity) {
  std::vector<const Json*> out;
  for (const Json& run : runs)
    if (error_of(run, quantity)) out.push_back(&run);
  const auto error = [&](const Json* run) { return *error_of(*run, quantity); };
  std::sort(out.begin(), out.end(), [&](const Json* a, const Json* b) {
    return std::pair(seconds_of(*a), error(a)) < std::pair(seconds_of(*b), error(b));
  });
  double least = std::numeric_limits<double>::infinity();
  std::erase_if(out, [&](const Json* run) {
    if (error(run) >= least) return true;
    least = error(run);
    return false;
  });
  return out;
}

const Json* cheapest(const StudyRecords& runs, std::string_view quantity, double error) {
  const auto front = pareto_front(runs, quantity);
  const auto found = std::find_if(front.begin(), front.end(),
                                  [&](const Json* run) { return *error_of(*run, quantity) <= error; });
  return found == front.end() ? nullptr : *found;
}

const Json* most_accurate(const StudyRecords& runs, std::string_view quantity, double seconds) {
  const auto front = pareto_front(runs, quantity);
  const auto beyond =
      std::find_if(front.begin(), front.end(), [&](const Json* run) { return seconds_of(*run) > seconds; });
  return beyond == front.begin() ? nullptr : *(beyond - 1);
}

}  // namespace firn
