// Herschel-Bulkley, Bargteil's flow, Rankine's cut-off and the fluid: limits, rates and closed forms of a
// point.
#include <catch2/catch.hpp>

#include "tests/materials/flow_paths.h"

using namespace firn;
using namespace firn::test;

namespace {

HerschelBulkleyYue2015 foam_of(double eta, double h, double sigma_y = 50) {
  return make_model<HerschelBulkleyYue2015>({{"density", 100},
                                             {"youngs_modulus", 2600},
                                             {"poissons_ratio", 0.3},
                                             {"sigma_y", sigma_y},
                                             {"eta", eta},
                                             {"h", h}});
}

template <class Model>
double deviator_after_shear(const Model& model, double gamma, int steps, double time) {
  Led<Model, 3> led(model);
  led.shear(gamma, steps, time);
  return led.equivalent_stress() / std::sqrt(1.5);
}

FlowBargteil2007 putty(double dt_ref) {
  return make_model<FlowBargteil2007>({{"density", 1000},
                                       {"youngs_modulus", 1e4},
                                       {"poissons_ratio", 0.3},
                                       {"P_Y", 100},
                                       {"nu_flow", 0.05},
                                       {"dt_ref", dt_ref}});
}

RankineCutOff ice_of(double softening) {
  return make_model<RankineCutOff>({{"density", 917},
                                    {"youngs_modulus", 1e6},
                                    {"poissons_ratio", 0.3},
                                    {"tensile_strength", 1e4},
                                    {"softening_strain", softening}});
}

}  // namespace

TEST_CASE("Herschel-Bulkley is rate-independent without viscosity and elastic with much of it",
          "[materials]") {
  const double Y = std::sqrt(2.0 / 3) * 50;
  for (const double h : {0.3, 1.0, 2.0}) {
    CHECK(deviator_after_shear(foam_of(1e-9, h), 0.5, 200, 1) == Approx(Y).epsilon(1e-6));
    const double elastic = deviator_after_shear(foam_of(1, h, 1e9), 0.5, 200, 1);
    CHECK(deviator_after_shear(foam_of(1e12, h), 0.5, 200, 1) == Approx(elastic).epsilon(1e-4));
  }
}

TEST_CASE("Herschel-Bulkley flows steadily at Y + eta |dev D|^h", "[materials]") {
  const double Y = std::sqrt(2.0 / 3) * 50, eta = 5;
  for (const double h : {0.4, 1.0, 2.5})
    for (const double rate : {0.5, 2.0}) {
      const double D = rate / std::sqrt(2.0);  // |dev D| of a simple shear
      // The stress is 4 % of mu: b_bar turns by as much, to the second order.
      CHECK(deviator_after_shear(foam_of(eta, h), 3, 6000, 3 / rate) ==
            Approx(Y + eta * std::pow(D, h)).epsilon(3e-3));
    }
}

TEST_CASE("Herschel-Bulkley's overstress solves its equation for every exponent", "[materials]") {
  for (const double h : {0.05, 0.1, 0.5, 1.0, 3.0, 10.0})
    for (const double eta : {1e-6, 1.0, 1e6}) {
      const HerschelBulkley flow{50, eta, h, true};
      for (const double X : {1e-6, 1.0, 1e8})
        for (const double c : {1e-6, 1.0, 1e6}) {
          const double x = flow.overstress(X, c);
          // Where x is small beside X its equation holds to the round-off of X.
          CHECK(x + c * std::pow(x / eta, 1 / h) == Approx(X).epsilon(1e-10));
        }
    }
}

TEST_CASE("foam under a load creeps, and recovers what was elastic", "[materials]") {
  const HerschelBulkleyYue2015 foam = foam_of(500, 1, 0);
  Led<HerschelBulkleyYue2015, 3> led(foam);
  led.shear(0.2, 10, 1e-3);
  const double at_once = led.equivalent_stress();
  // Held, the stress dies away with the time eta / (2 mu) = 0.25 s.
  led.shear(0, 2500, 0.25);
  CHECK(led.equivalent_stress() == Approx(at_once * std::exp(-1.0)).epsilon(0.01));
}

TEST_CASE("Bargteil's flow does not depend on the step", "[materials]") {
  const auto relaxed = [](int steps) {
    Led<FlowBargteil2007, 3> led(putty(1e-3));
    led.stretch(0.1, 1, 0);
    led.stretch(0, steps, 0.02);
    return led.equivalent_stress();
  };
  const double fine = relaxed(4000), one = relaxed(20), two = relaxed(40);
  CHECK(two == Approx(fine).epsilon(0.03));
  CHECK((one - fine) / (two - fine) == Approx(2).epsilon(0.15));  // first order
}

TEST_CASE("Rankine's cut-off ends on the strength in one, two and three axes", "[materials]") {
  const RankineCutOff ice = ice_of(kInfinity);
  const double mu = ice.moduli.mu, lam = ice.moduli.lam;
  const auto stretched = [&](double a, double b, double c) {
    auto p = ice.at_rest<double, 3>();
    p.F_E = Matrix<double, 3>::diagonal({std::exp(a), std::exp(b), std::exp(c)});
    return ice.update(p, 1e-3).tau;
  };
  const auto one = stretched(-0.01, 0.04, -0.02);
  CHECK(one(1, 1) == Approx(1e4).epsilon(1e-12));
  // By x = (tau - T) / (2 mu + lam), which the others feel as -lam x.
  const double x = (2 * mu * 0.04 + lam * 0.01 - 1e4) / (2 * mu + lam);
  CHECK(one(0, 0) == Approx(2 * mu * -0.01 + lam * (0.01 - x)).epsilon(1e-12));
  const auto two = stretched(0.03, -0.05, 0.06);
  CHECK(two(0, 0) == Approx(1e4).epsilon(1e-12));
  CHECK(two(2, 2) == Approx(1e4).epsilon(1e-12));
  CHECK(two(1, 1) < 1e4);
  const auto three = stretched(0.03, 0.02, 0.06);
  for (int k = 0; k < 3; ++k) CHECK(three(k, k) == Approx(1e4).epsilon(1e-12));
}

TEST_CASE("a softening crack loses its strength with its opening", "[materials]") {
  const RankineCutOff ice = ice_of(0.1);
  Led<RankineCutOff, 3> led(ice);
  led.swell(0.1, 1000);
  CHECK(led.response.tau(0, 0) == Approx(1e4 * std::exp(-led.point.history.alpha / 0.1)).epsilon(1e-6));
  CHECK(led.point.history.alpha > 0.25);
}

TEST_CASE("the fluid's pressure is Tait's, whatever its shape", "[materials]") {
  const auto water = make_model<Fluid>({{"bulk_modulus", 1e5}});
  auto p = water.at_rest<double, 3>();
  p.F_E = Matrix<double, 3>::diagonal({2, 0.5, 0.95});
  const auto r = water.update(p, 1e-3);
  const double pressure = 1e5 / 7 * (std::pow(0.95, -7) - 1);
  CHECK(-r.tau(0, 0) / 0.95 == Approx(pressure).epsilon(1e-12));
  CHECK(r.tau(0, 0) == Approx(r.tau(2, 2)).epsilon(1e-14));
  CHECK(largest_entry(p.F_E - Matrix<double, 3>::scaled_identity(std::cbrt(0.95))) < 1e-15);
}

TEST_CASE("a viscous fluid sheared carries eta times the rate", "[materials]") {
  for (const double eta : {0.01, 1.0, 50.0}) {
    const auto honey = make_model<Fluid>({{"bulk_modulus", 1e6}, {"viscosity", eta}});
    Led<Fluid, 3> led(honey);
    const double rate = 20;
    led.shear(rate * 0.1, 2000, 0.1);
    // Its elastic strain is eta rate / mu = 1 % at most.
    CHECK(led.response.tau(0, 1) == Approx(eta * rate).epsilon(1e-3));
    CHECK(determinant(led.point.F_E) == Approx(1).epsilon(1e-10));
  }
}
