#include "tools/cli/materials.h"

#include <sstream>

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "materials/model_info.h"

using namespace firn;

TEST_CASE("firn materials shows every model, parameter, unit, range, default and source", "[materials]") {
  std::ostringstream all, one, markdown;
  CHECK(run_materials("", all) == 0);
  CHECK(run_materials("snow_stomakhin_2013", one) == 0);
  CHECK(run_materials_markdown(markdown) == 0);
  for (const ModelInfo& m : models()) {
    CHECK(all.str().find(m.name) != std::string::npos);
    CHECK(all.str().find(m.source) != std::string::npos);
    CHECK(markdown.str().find(m.name) != std::string::npos);
    for (const Parameter& p : m.parameters) {
      CHECK(all.str().find(p.meaning) != std::string::npos);
      CHECK(all.str().find(p.range()) != std::string::npos);
      CHECK(markdown.str().find(p.name) != std::string::npos);
    }
  }
  CHECK(one.str().find("theta_c         -       0.025") != std::string::npos);
  CHECK(one.str().find("neo_hookean") == std::string::npos);
}

TEST_CASE("firn materials names the nearest model", "[materials]") {
  std::ostringstream out;
  try {
    run_materials("stvk_henky", out);
    FAIL("accepted");
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::input);
    CHECK(std::string(e.what()) ==
          "unknown model or preset 'stvk_henky'; did you mean 'stvk_hencky'? known: neo_hookean, "
          "fixed_corotated, "
          "stvk_hencky, snow_stomakhin_2013, sand_klar_2016, sand_perzyna, von_mises, von_mises_voce, "
          "johnson_cook_1983, von_mises_perzyna, nacc_wolper_2019, herschel_bulkley_yue_2015, "
          "flow_bargteil_2007, "
          "rankine, fluid, snow_powder, snow_wet, snow_packed, ice, dry_sand, wet_sand, mud, clay, foam, "
          "honey, "
          "water, rubber, jello, copper");
  }
}
