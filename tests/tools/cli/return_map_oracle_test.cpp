// Return maps of the models that yield at a stress against values computed elsewhere at high precision, asked
// for as a user does. The files under tests/data/oracles state a tolerance beside each value, relative to the
// value's largest entry where that exceeds 1. dFP: the plastic increment F_E^-1 F_trial, which is F_P from
// F_P = I.
#include <catch2/catch.hpp>

#include "tests/tools/cli/oracles.h"

using nlohmann::json;
using namespace firn::test;

namespace {

/// `keys`: what the oracle calls a value, and where the answer has it.
int check_all(const std::string& model, const json& more, const std::map<std::string, std::string>& keys) {
  int count = 0;
  for (const json& o : oracles(model)) {
    INFO(model << " " << o["name"] << " D=" << o["d"]);
    json material = o["params"];
    material.erase("friction_angle_deg");  // of which M was computed
    material["model"] = model;
    material.update(more);
    const double dt = material.value("dt", 1e-3);
    material.erase("dt");
    json state = o["in"];
    state.erase("F");
    const json answer = ask({{"dimension", o["d"]},
                             {"dt", dt},
                             {"material", material},
                             {"F_trial", o["in"]["F"]},
                             {"state", state}});
    const json &out = o["out"], &tol = o["tol"];
    for (const auto& [theirs, pointer] : keys) {
      if (!out.contains(theirs)) continue;
      INFO(theirs);
      check_value(answer.at(json::json_pointer(pointer)), out[theirs], tol[theirs]);
    }
    CHECK(answer["branch"] == out["case"]);
    ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("von Mises agrees with the oracle's return maps", "[oracle]") {
  CHECK(check_all("von_mises", json::object(),
                  {{"FE", "/F_E"}, {"dFP", "/F_P"}, {"alpha", "/state/alpha"}}) == 23);
}
TEST_CASE("sand agrees with the oracle's return maps", "[oracle]") {
  CHECK(check_all("sand_klar_2016", {{"volume_correction", false}},
                  {{"FE", "/F_E"}, {"dFP", "/F_P"}, {"q", "/state/q"}}) == 16);
}
TEST_CASE("Cam-clay agrees with the oracle's return maps, as published", "[oracle]") {
  CHECK(check_all("nacc_wolper_2019", {{"volume", "published"}},
                  {{"FE", "/F_E"}, {"alpha", "/state/alpha"}}) == 27);
}
TEST_CASE("Cam-clay agrees with the oracle's return maps that keep the volume", "[oracle]") {
  CHECK(check_all("nacc_wolper_2019", json::object(),
                  {{"FE_Jpreserving", "/F_E"}, {"alpha", "/state/alpha"}}) == 27);
}
TEST_CASE("Bargteil's flow agrees with the oracle", "[oracle]") {
  CHECK(check_all("flow_bargteil_2007", {{"dt_ref", 1e-3}}, {{"FE", "/F_E"}, {"dFP", "/F_P"}}) == 12);
}
TEST_CASE("Herschel-Bulkley agrees with the oracle's return maps that keep the volume", "[oracle]") {
  CHECK(check_all("herschel_bulkley_yue_2015", json::object(), {{"FE", "/F_E"}}) == 23);
}
TEST_CASE("Herschel-Bulkley agrees with the oracle's return maps, as published", "[oracle]") {
  CHECK(check_all("herschel_bulkley_yue_2015", {{"volume", "published"}}, {{"FE_trace", "/F_E"}}) == 23);
}
