// The models' own descriptions, and what is made from them.
#include "materials/registry.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "tests/materials/model_cases.h"

using namespace firn;
using namespace firn::test;

namespace {

template <class Energy, class Yield, class Harden>
concept Composes = requires {
  typename ElastoPlastic<Energy, Yield, Harden>;
};

// A yield set that is right only for one energy.
struct HenckyOnly : SingularValueClamp {
  template <class Energy>
  static constexpr bool valid_with = std::same_as<Energy, StvkHenckyEnergy>;
};

static_assert(Composes<FixedCorotatedEnergy, SingularValueClamp, ExponentialCompaction>);
static_assert(Composes<StvkHenckyEnergy, HenckyOnly, ExponentialCompaction>);
static_assert(!Composes<FixedCorotatedEnergy, HenckyOnly, ExponentialCompaction>,
              "a wrong pair must not compile");
static_assert(!Composes<SingularValueClamp, SingularValueClamp, ExponentialCompaction>);
static_assert(!Composes<FixedCorotatedEnergy, ExponentialCompaction, SingularValueClamp>);

ParameterValues sample_values(const ModelInfo& m) {
  ParameterValues values;
  for (const Parameter& p : m.parameters) values.emplace(p.name, p.required() ? 0.25 : p.default_value);
  return values;
}

TEST_CASE("the defaults of snow are those of its paper's table") {
  // Stomakhin et al. 2013, table 1; nothing there bounds the hardening.
  const std::map<std::string_view, double> table{{"density", 400},        {"youngs_modulus", 1.4e5},
                                                 {"poissons_ratio", 0.2}, {"xi", 10},
                                                 {"theta_c", 2.5e-2},     {"theta_s", 7.5e-3}};
  for (const Parameter& p : find_model("snow_stomakhin_2013")->parameters) {
    if (p.name == "hardening_cap") continue;
    CHECK(p.default_value == table.at(p.name));
  }
}

}  // namespace

TEST_CASE("every model is found by its name and made from its parameters", "[materials]") {
  CHECK(models().size() == std::variant_size_v<Material>);
  for (const ModelInfo& m : models()) {
    CHECK(find_model(m.name) == &m);
    const Material made = make_material(m.name, sample_values(m));
    std::visit(
        [&](const auto& model) {
          CHECK(model.name == m.name);
          CHECK(model.density == sample_values(m).at("density"));
        },
        made);
  }
  CHECK(find_model("snow") == nullptr);
}

TEST_CASE("every model describes itself in full", "[materials]") {
  std::set<std::string_view> names;
  for (const ModelInfo& m : models()) {
    CHECK(names.insert(m.name).second);
    CHECK_FALSE(m.title.empty());
    CHECK_FALSE(m.source.empty());
    CHECK(m.columns.has(Column::elastic_deformation));
    CHECK(m.columns.has(Column::plastic_deformation) == (m.yield != "none"));
    REQUIRE_FALSE(m.parameters.empty());
    CHECK(m.parameters[0].name == "density");
    std::set<std::string_view> parameters;
    for (const Parameter& p : m.parameters) {
      CHECK(parameters.insert(p.name).second);
      CHECK_FALSE(p.unit.empty());
      CHECK_FALSE(p.meaning.empty());
      CHECK((p.required() || p.allows(p.default_value)));
    }
  }
}

TEST_CASE("a parameter's range reads as a sentence's end", "[materials]") {
  CHECK(Parameter{"x", "-", "m"}.range() == "any number");
  CHECK(Parameter{"x", "-", "m", 1, 0, kInfinity, true}.range() == "> 0");
  CHECK(Parameter{"x", "-", "m", 1, -kInfinity, 2}.range() == "<= 2");
  CHECK(Parameter{"x", "-", "m", 1, -1, 0.5, true, true}.range() == "in (-1, 0.5)");
  CHECK_FALSE((Parameter{"x", "-", "m", 1, -1, 0.5, true, true}.allows(-1)));
  CHECK_FALSE((Parameter{"x", "-", "m", 1, 0, 1}.allows(kRequired)));
}

TEST_CASE("Lame's moduli follow from Young's modulus and Poisson's ratio", "[materials]") {
  // E = 100, nu = 0.25: mu = lam = 40, exactly representable up to a rounding.
  CHECK(lame(100, 0.25).mu == Approx(40).epsilon(1e-15));
  CHECK(lame(100, 0.25).lam == Approx(40).epsilon(1e-15));
  CHECK(lame(100, 0).lam == 0);
}
