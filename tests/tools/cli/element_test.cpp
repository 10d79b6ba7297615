// The contract of `firn element`: one line in, one line out, whatever the line is.
#include "tools/cli/element.h"

#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using nlohmann::json;

namespace {

struct Answer {
  int exit_code;
  std::vector<json> lines;
};

Answer run(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out;
  Answer answer{firn::run_element(in, out), {}};
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);) answer.lines.push_back(json::parse(line));
  return answer;
}

// The error of one bad line that is `fields` beside a valid id.
std::string error_of(const std::string& fields) {
  const Answer a = run("{\"id\":\"x\"," + fields + "}\n");
  CHECK(a.exit_code == 2);
  REQUIRE(a.lines.size() == 1);
  CHECK(a.lines[0].size() == 2);
  CHECK(a.lines[0]["id"] == "x");
  return a.lines[0]["error"];
}

const std::string kSoft = R"("material":{"model":"neo_hookean","mu":2,"lam":3})";
const std::string kF = R"("F_trial":[[1.1,0],[0,0.9]])";

std::string error_of_material(const std::string& material) {
  return error_of(kF + ",\"material\":{" + material + "}");
}

}  // namespace

TEST_CASE("element answers each line in order with its id", "[element]") {
  const Answer a = run("{\"id\":\"a\"," + kSoft + "," + kF + "}\n\n  \n{\"id\":7," + kSoft + "," + kF + "}");
  CHECK(a.exit_code == 0);
  REQUIRE(a.lines.size() == 2);
  CHECK(a.lines[0]["id"] == "a");
  CHECK(a.lines[1]["id"] == 7);
  CHECK(a.lines[0]["branch"] == "elastic");
  CHECK(a.lines[0]["F_P"] == json::parse("[[1.0,0.0],[0.0,1.0]]"));
  CHECK(a.lines[0]["state"] == json::object());
  CHECK_FALSE(a.lines[0].contains("dPdF"));
}

TEST_CASE("element gives the closed-form stress of a uniaxial stretch", "[element]") {
  const Answer a = run("{" + kSoft + R"(,"dimension":1,"F_trial":[[2]],"tangent":true})");
  REQUIRE(a.exit_code == 0);
  const json& line = a.lines[0];
  CHECK(line["id"].is_null());
  // Three operations each: a few units in the last place.
  CHECK(line["tau"][0][0].get<double>() == Approx(2 * 3 + 3 * std::log(2)).epsilon(1e-14));
  CHECK(line["P"][0][0].get<double>() == Approx((2 * 3 + 3 * std::log(2)) / 2).epsilon(1e-14));
  CHECK(line["psi"].get<double>() ==
        Approx(3 - 2 * std::log(2) + 1.5 * std::log(2) * std::log(2)).epsilon(1e-14));
  CHECK(line["dPdF"][0][0].get<double>() == Approx(2 + (2 + 3 - 3 * std::log(2)) / 4).epsilon(1e-14));
}

TEST_CASE("element takes Young's modulus and Poisson's ratio or Lame's moduli", "[element]") {
  // E = 100, nu = 0.25 is mu = lam = 40.
  const Answer a =
      run(R"({"material":{"model":"stvk_hencky","youngs_modulus":100,"poissons_ratio":0.25},)" + kF + "}\n" +
          R"({"material":{"model":"stvk_hencky","density":5,"mu":40,"lam":40},)" + kF + "}");
  REQUIRE(a.exit_code == 0);
  CHECK(a.lines[0] == a.lines[1]);
}

TEST_CASE("element gives snow's state and its defaults", "[element]") {
  const Answer a = run(R"({"material":{"model":"snow_stomakhin_2013"},"F_trial":[[0.95,0],[0,1.0]]})");
  REQUIRE(a.exit_code == 0);
  CHECK(a.lines[0]["branch"] == "ML");
  const double J_P = 0.95 / 0.975;
  CHECK(a.lines[0]["state"]["J_P"].get<double>() == Approx(J_P).epsilon(1e-14));
  CHECK(a.lines[0]["state"]["mu"].get<double>() ==
        Approx(1.4e5 / 2.4 * std::exp(10 * (1 - J_P))).epsilon(1e-13));
  CHECK(a.lines[0]["capped"] == false);
}

TEST_CASE("element says what is wrong with a line and goes on", "[element]") {
  const Answer a = run("{\"id\":1}\n{\"id\":2," + kSoft + "," + kF + "}\n");
  CHECK(a.exit_code == 2);
  REQUIRE(a.lines.size() == 2);
  CHECK(a.lines[0]["error"] == "F_trial: is missing");
  CHECK(a.lines[1].contains("psi"));
}

TEST_CASE("element names the nearest model, parameter and key", "[element]") {
  CHECK(error_of_material(R"("model":"snow_stomakin_2013")") ==
        "material.model: unknown model 'snow_stomakin_2013'; did you mean 'snow_stomakhin_2013'? known: "
        "neo_hookean, "
        "fixed_corotated, stvk_hencky, snow_stomakhin_2013, sand_klar_2016, sand_perzyna, von_mises, "
        "von_mises_voce, johnson_cook_1983, von_mises_perzyna, nacc_wolper_2019, "
        "herschel_bulkley_yue_2015, flow_bargteil_2007, rankine, fluid");
  CHECK(error_of_material(R"("model":"snow_stomakhin_2013","thetac":0.1)") ==
        "unknown parameter of 'snow_stomakhin_2013' 'thetac'; did you mean 'theta_c'? known: model, mu, lam, "
        "kappa, "
        "density, "
        "youngs_modulus, poissons_ratio, theta_c, theta_s, xi, hardening_cap");
  CHECK(error_of(kSoft + R"(,"F_trail":[[1]])") ==
        "unknown key 'F_trail'; did you mean 'F_trial'? known: id, dimension, "
        "dt, material, F_trial, F_P, state, tangent");
}

TEST_CASE("element refuses values out of range, of the wrong shape or missing", "[element]") {
  CHECK(error_of_material(R"("model":"snow_stomakhin_2013","theta_c":1)") ==
        "material.theta_c: found 1; allowed: in [0, 1)");
  CHECK(error_of_material(R"("model":"snow_stomakhin_2013","hardening_cap":"no")") ==
        "material.hardening_cap: found \"no\"; a number is needed");
  CHECK(error_of_material(R"("model":"neo_hookean","youngs_modulus":1,"poissons_ratio":0.5)") ==
        "material.poissons_ratio: found 0.5; allowed: in (-1, 0.5)");
  CHECK(error_of_material(R"("model":"neo_hookean","youngs_modulus":1)") ==
        "material.poissons_ratio: is missing; nu: lateral contraction over extension, in (-1, 0.5)");
  CHECK(error_of_material(R"("model":"neo_hookean","lam":1)") ==
        "material.mu: is missing; mu goes with lam or kappa");
  CHECK(error_of_material(R"("model":"neo_hookean","mu":-1,"lam":0)") ==
        "material.mu: found -1; allowed: in (0, 1e+15]");
  CHECK(error_of_material(R"("mu":-1)") == "material.model: is missing");
  CHECK(error_of(kF) == "material: is missing");
  CHECK(error_of(kSoft + R"(,"F_trial":[[1,0],[0]])") ==
        "F_trial: found [[1,0],[0]]; 2 rows of 2 numbers are needed");
  CHECK(error_of(kSoft + R"(,"dimension":3,)" + kF) ==
        "F_trial: found [[1.1,0],[0,0.9]]; 3 rows of 3 numbers are needed");
  CHECK(error_of(kSoft + R"(,"dimension":4,)" + kF) == "dimension: found 4; allowed: 1, 2, 3");
  CHECK(error_of(kSoft + R"(,"F_trial":5)") == "F_trial: found 5; 1, 2 or 3 rows are needed");
  CHECK(error_of(kSoft + R"(,"dt":-1,)" + kF) == "dt: found -1; allowed: >= 0");
  CHECK(error_of(kSoft + R"(,"tangent":1,)" + kF) == "tangent: allowed: true, false");
  CHECK(error_of(kSoft + R"(,"state":{"q":1},)" + kF) ==
        "state: unknown key 'q'; this model's whole state is F_P");
  CHECK(error_of(kSoft + R"(,"F_trial":[[1e300,0],[0,1e300]])") ==
        "F_trial or F_P is so large that the answer overflows");
}

TEST_CASE("element survives hostile lines", "[element]") {
  const auto first_error = [](const std::string& line) {
    const Answer a = run(line + "\n");
    CHECK(a.exit_code == 2);
    REQUIRE(a.lines.size() == 1);
    CHECK(a.lines[0]["id"].is_null());
    return a.lines[0]["error"].get<std::string>();
  };
  CHECK(first_error(std::string(60000, '[')) == "nested more than 8 levels deep");
  CHECK(first_error(std::string(1 << 20, ' ') + "x") == "the line is longer than 65536 bytes");
  CHECK(first_error("{" + kF + "," + kF + "}") == "key 'F_trial' is given twice");
  CHECK(first_error("{\"a\":{\"b\":1,\"b\":2}}") == "key 'b' is given twice");
  CHECK(first_error("[1,2]") == "found [1,2]; an object is needed");
  CHECK(first_error("{\"id\"").substr(0, 15) == "not valid JSON:");
  CHECK(first_error("{\"id\":\"\xff\xfe\"}").substr(0, 15) == "not valid JSON:");
  CHECK(first_error("{\"F_trial\":[[1e999]]}").substr(0, 15) == "not valid JSON:");
  // Brackets in a string are no nesting, and an escaped backslash does not keep the string open.
  CHECK(first_error(R"({"a\"[[[[[[[[[[":1})").find("unknown key 'a\"[[[") == 0);
  CHECK(first_error(R"({"a":"\\","b":[[[[[[[[[[]]]]]]]]]]})") == "nested more than 8 levels deep");
  CHECK(first_error(R"({"id":[1],"F_trial":"[[[[[[[[[[[["})").find("F_trial: found") == 0);
}
