#include "tools/cli/study/front.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tools/cli/study/parse.h"

namespace firn {
namespace {

using Json = nlohmann::ordered_json;

Json run(const char* id, double seconds, const Json& error, const char* state = "finished") {
  return {{"id", id},
          {"state", state},
          {"seconds", {{"median", seconds}}},
          {"error", {{"displacement", {{"l2", error}, {"max", error}}}}}};
}

const StudyRecords kRuns{run("slow", 10, 0.01),       run("quick", 1, 0.3), run("beaten", 5, 0.2),
                         run("good", 4, 0.1),         run("same", 4, 0.15), run("failed", 0.1, 0.0, "failed"),
                         run("unknown", 0.1, nullptr)};

std::string id_of(const Json* found) {
  return found == nullptr ? "none" : (*found)["id"].get<std::string>();
}

TEST_CASE("the front has the runs that no other one beats in both, by seconds") {
  std::string ids;
  for (const Json* r : pareto_front(kRuns, "displacement")) ids += id_of(r) + " ";
  CHECK(ids == "quick good slow ");
  CHECK(pareto_front(kRuns, "stress").empty());
  CHECK(pareto_front({}, "displacement").empty());
}

TEST_CASE("the cheapest run of an error, and the most accurate of a time") {
  CHECK(id_of(cheapest(kRuns, "displacement", 0.5)) == "quick");
  CHECK(id_of(cheapest(kRuns, "displacement", 0.1)) == "good");
  CHECK(id_of(cheapest(kRuns, "displacement", 0.05)) == "slow");
  CHECK(id_of(cheapest(kRuns, "displacement", 0.001)) == "none");
  CHECK(id_of(most_accurate(kRuns, "displacement", 0.5)) == "none");
  CHECK(id_of(most_accurate(kRuns, "displacement", 9)) == "good");
  CHECK(id_of(most_accurate(kRuns, "displacement", 100)) == "slow");
}

TEST_CASE("errors and times as people write them") {
  CHECK(parse_error("1%") == 0.01);
  CHECK(parse_error("0.02") == 0.02);
  CHECK(parse_seconds("500ms") == 0.5);
  CHECK(parse_seconds("10m") == 600);
  CHECK(parse_seconds("1.5h") == 5400);
  CHECK(parse_seconds("7") == 7);
  for (const char* wrong : {"", "%", "-1%", "0", "1 %%", "nan", "inf", "1e999"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(parse_error(wrong), Error);
    CHECK_THROWS_AS(parse_seconds(wrong), Error);
  }
}

}  // namespace
}  // namespace firn
