// Values computed elsewhere, at high precision, for energies and return maps: asked for as a user does, line
// by line through `firn element`. The files under tests/data/oracles state a tolerance beside each value;
// those of return maps are relative to the value's largest entry where that exceeds 1.
#include <catch2/catch.hpp>

#include "engine/math/svd.h"
#include "tests/tools/cli/oracles.h"

using nlohmann::json;
using namespace firn::test;

namespace {

void check_energy(const std::string& model) {
  for (const json& o : oracles(model)) {
    const json answer = ask({{"id", o["name"]},
                             {"dimension", o["d"]},
                             {"material", {{"model", model}, {"mu", o["mu"]}, {"lam", o["lam"]}}},
                             {"F_trial", o["F"]},
                             {"tangent", true}});
    INFO(o["name"] << " D=" << o["d"]);
    CHECK(answer["id"] == o["name"]);
    for (const char* key : {"psi", "P", "dPdF"}) {
      INFO(key);
      CHECK(largest_difference(answer[key], o[key]) <= o["abstol"][key].get<double>());
    }
  }
}

json ask_snow(const json& o) {
  const json& p = o["params"];
  return ask({{"dimension", o["d"]},
              {"dt", 1e-3},
              {"material",
               {{"model", "snow_stomakhin_2013"},
                {"mu", p["mu0"]},
                {"lam", p["lambda0"]},
                {"theta_c", p["theta_c"]},
                {"theta_s", p["theta_s"]},
                {"xi", p["xi"]},
                {"hardening_cap", 1e308}}},
              {"F_trial", o["in"]["F"]},
              {"F_P", o["in"]["FP"]}});
}

template <int D>
void check_invariants(const json& rows, const json& invariants) {
  firn::Matrix<double, D> F_E;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t j = 0; j < D; ++j) F_E.m[i][j] = rows[i][j];
  if (invariants["det_FE_positive"]) CHECK(determinant(F_E) > 0);
  const auto s = firn::svd(F_E).s;
  // The clamped values come back from F_E with a few roundings.
  CHECK(s[0] <= invariants["sv_in"][1].get<double>() + 1e-14);
  CHECK(s[D - 1] >= invariants["sv_in"][0].get<double>() - 1e-14);
}

}  // namespace

TEST_CASE("fixed corotated agrees with the oracle in energy, stress and tangent", "[oracle]") {
  check_energy("fixed_corotated");
}
TEST_CASE("neo-Hookean agrees with the oracle in energy, stress and tangent", "[oracle]") {
  check_energy("neo_hookean");
}
TEST_CASE("StVK-Hencky agrees with the oracle in energy, stress and tangent", "[oracle]") {
  check_energy("stvk_hencky");
}

TEST_CASE("snow agrees with the oracle's return maps", "[oracle]") {
  int values = 0, properties = 0;
  for (const json& o : oracles("snow_stomakhin_2013")) {
    INFO(o["name"] << " D=" << o["d"]);
    const json answer = ask_snow(o);
    if (o["kind"] == "value") {
      const json &out = o["out"], &tol = o["tol"];
      CHECK(answer["branch"] == out["case"]);
      check_value(answer["F_E"], out["FE"], tol["FE"]);
      check_value(answer["F_P"], out["FP"], tol["FP"]);
      check_value(answer["state"]["J_P"], out["JP"], tol["JP"]);
      check_value(answer["state"]["mu"], out["mu"], tol["mu"]);
      check_value(answer["state"]["lam"], out["lam"], tol["lam"]);
      ++values;
    } else {
      o["d"] == 2 ? check_invariants<2>(answer["F_E"], o["invariants"])
                  : check_invariants<3>(answer["F_E"], o["invariants"]);
      ++properties;
    }
  }
  CHECK(values == 12);
  CHECK(properties == 2);
}
