// Sand and Cam-clay: friction, volume and cohesion of a point.
#include <catch2/catch.hpp>

#include "tests/materials/flow_paths.h"

using namespace firn;
using namespace firn::test;

namespace {

SandKlar2016 sand_of(double degrees, double correction = 1, double strength = 0) {
  return make_model<SandKlar2016>({{"h0", degrees},
                                   {"h1", 0},
                                   {"h3", 0},
                                   {"tensile_strength", strength},
                                   {"volume_correction", correction}});
}

template <int D>
double steady_friction(const SandKlar2016& sand) {
  Led<SandKlar2016, D> led(sand);
  led.swell(-0.001, 1);
  led.shear(0.5, 20000, 1);
  return led.response.tau(0, 1) / led.pressure();
}

NaccWolper2019 clay_of(bool keeps_volume) {
  return make_model<NaccWolper2019>({{"density", 1000},
                                     {"youngs_modulus", 1e6},
                                     {"poissons_ratio", 0.3},
                                     {"M", 1.2},
                                     {"beta", 0.5},
                                     {"xi", 3},
                                     {"alpha_0", -0.02},
                                     {"volume", keeps_volume ? 0 : 1}});
}

}  // namespace

TEST_CASE("sand in steady simple shear has tau / p of its friction angle", "[materials]") {
  for (const double degrees : {30.0, 35.0, 40.0}) {
    const double sine = std::sin(degrees * std::numbers::pi / 180);
    const double a = std::sqrt(2.0 / 3) * 2 * sine / (3 - sine);
    const SandKlar2016 sand = sand_of(degrees);
    CAPTURE(degrees);
    CHECK(steady_friction<2>(sand) == Approx(std::sqrt(2.0) * a).epsilon(1e-4));
    CHECK(steady_friction<3>(sand) == Approx(3 * a / std::sqrt(2.0)).epsilon(1e-4));
  }
  // As printed in the tables of verification numbers.
  CHECK(steady_friction<2>(sand_of(30)) == Approx(0.46188).epsilon(1e-4));
  CHECK(steady_friction<3>(sand_of(30)) == Approx(0.69282).epsilon(1e-4));
  CHECK(steady_friction<2>(sand_of(35)) == Approx(0.54591).epsilon(1e-4));
  CHECK(steady_friction<3>(sand_of(35)) == Approx(0.81887).epsilon(1e-4));
  CHECK(steady_friction<2>(sand_of(40)) == Approx(0.62975).epsilon(1e-4));
  CHECK(steady_friction<3>(sand_of(40)) == Approx(0.94462).epsilon(1e-4));
}

TEST_CASE("sand yields to no pressure from all sides", "[materials]") {
  Led<SandKlar2016, 3> led(sand_of(30));
  led.swell(-0.2, 20);
  CHECK(led.point.history.alpha == 0);
  CHECK(determinant(led.point.F_E) == Approx(std::exp(-0.6)).epsilon(1e-12));
}

TEST_CASE("sand that came apart carries nothing, and again what it did once it is as dense", "[materials]") {
  const SandKlar2016 sand = sand_of(30);
  Led<SandKlar2016, 3> led(sand), fresh(sand);
  led.swell(0.1, 30);
  CHECK(largest_entry(led.response.tau) < 1e-9 * sand.moduli.p_wave());
  CHECK(led.point.history.volume_gain == Approx(0.3).epsilon(1e-12));
  led.swell(-0.0999, 30);
  CHECK(led.pressure() < 1e-9 * sand.moduli.p_wave());
  led.swell(-0.0101, 30);
  fresh.swell(-0.01, 30);
  CHECK(led.pressure() == Approx(fresh.pressure()).epsilon(1e-10));
  CHECK(led.point.history.volume_gain == 0);
}

TEST_CASE("sand landing a hundred times gains no volume, without the correction it swells", "[materials]") {
  // Up and apart, down again and sheared a little: the strain at which it presses tells its volume.
  const auto strain_at_contact = [](bool corrected) {
    const SandKlar2016 sand = sand_of(30, corrected ? 1 : 0);
    Led<SandKlar2016, 2> led(sand);
    double strain = 0;
    for (int n = 0; n < 100; ++n) {
      led.swell(0.05, 10), strain += 0.05;
      while (led.pressure() < 1e-4 * sand.moduli.p_wave()) led.swell(-1e-4, 1), strain -= 1e-4;
      led.shear(0.01, 10, 0.01);
    }
    return strain;
  };
  CHECK(std::fabs(2 * strain_at_contact(true)) < 0.01);
  CHECK(2 * strain_at_contact(false) > 1);
}

TEST_CASE("damp sand carries the tension it is given, then lets go", "[materials]") {
  const SandKlar2016 sand = sand_of(30, 1, 500);
  Led<SandKlar2016, 3> led(sand);
  led.swell(0.05, 50);
  CHECK(led.pressure() == Approx(-500).epsilon(1e-9));
}

TEST_CASE("the friction angle grows and settles as published", "[materials]") {
  const FrictionAngle klar{35, 9, 0.2, 10};
  CHECK(klar.degrees(0.0) == 25);
  CHECK(klar.degrees(0.25) == Approx(27.627971960119467).epsilon(1e-13));
  CHECK(klar.degrees(1e3) == Approx(35).epsilon(1e-13));
}

TEST_CASE("sand with a viscosity slips later, and the more the faster it is sheared", "[materials]") {
  const auto thick = make_model<SandPerzyna>({{"h0", 30}, {"h1", 0}, {"h3", 0}, {"eta", 1e3}});
  double last = 0;
  for (const double time : {1e6, 1e2, 1.0, 1e-2}) {
    Led<SandPerzyna, 3> led(thick);
    led.swell(-0.001, 1);
    led.shear(0.1, 2000, time);
    const double ratio = led.response.tau(0, 1) / led.pressure();
    if (time == 1e6) CHECK(ratio == Approx(0.69282).epsilon(1e-3));
    CHECK(ratio > last);
    last = ratio;
  }
}

TEST_CASE("Cam-clay sheared keeps its volume, as published it does not", "[materials]") {
  auto F = Matrix<double, 3>::identity();
  F(0, 1) = 0.5;
  for (const bool keeps : {true, false}) {
    const NaccWolper2019 clay = clay_of(keeps);
    auto p = clay.at_rest<double, 3>();
    p.F_E = F;
    clay.update(p, 1e-3);
    if (keeps) CHECK(determinant(p.F_E) == Approx(1).epsilon(1e-13));
    if (!keeps) CHECK(determinant(p.F_E) > 1.01);
  }
}

TEST_CASE("Cam-clay sheared hardens by where the line from the ellipse's centre crosses it", "[materials]") {
  const NaccWolper2019 clay = clay_of(true);
  const double kappa = IsochoricNeoHookeanEnergy::bulk_modulus<3>(clay.moduli), M = 1.2, beta = 0.5;
  const double p0 = kappa * (1e-5 + std::sinh(3 * 0.02));
  for (const double side : {0.99, 1.003}) {
    auto F = Matrix<double, 3>::scaled_identity(side);
    F(0, 1) = 0.4;
    const double J = determinant(F), p = -kappa / 2 * (J * J - 1), centre = p0 * (1 - beta) / 2;
    Matrix<double, 3> dev = std::pow(J, -2.0 / 3) * F * transpose(F);
    const double mean = trace(dev) / 3;
    for (int k = 0; k < 3; ++k) dev(k, k) -= mean;
    const double s2 = clay.moduli.mu * clay.moduli.mu * frobenius2(dev);
    // By halving, on the yield function as published.
    double inside = 0, outside = 1;
    for (int n = 0; n < 60; ++n) {
      const double part = 0.5 * (inside + outside), p_x = centre + part * (p - centre);
      const double y = 1.5 * (1 + 2 * beta) * part * part * s2 + M * M * (p_x + beta * p0) * (p_x - p0);
      (y < 0 ? inside : outside) = part;
    }
    const double J_x = std::sqrt(1 - 2 * (centre + inside * (p - centre)) / kappa);
    auto point = clay.at_rest<double, 3>();
    point.F_E = F;
    clay.update(point, 1e-3);
    CAPTURE(side, p / p0);
    CHECK(point.history.alpha == Approx(-0.02 + std::log(J / J_x)).epsilon(1e-11));
  }
}

TEST_CASE("Cam-clay hardens as it is crushed and softens as it is torn", "[materials]") {
  const NaccWolper2019 clay = clay_of(true);
  const double kappa = IsochoricNeoHookeanEnergy::bulk_modulus<3>(clay.moduli);
  const double p0 = kappa * (1e-5 + std::sinh(3 * 0.02));
  Led<NaccWolper2019, 3> crushed(clay), torn(clay);
  crushed.swell(-0.1, 1);
  CHECK(crushed.pressure() == Approx(p0).epsilon(1e-12));
  CHECK(crushed.point.history.alpha < -0.2);
  torn.swell(0.1, 1);
  CHECK(torn.pressure() == Approx(-0.5 * p0).epsilon(1e-12));
  CHECK(torn.point.history.alpha > 0.2);
  torn.swell(0.001, 1);
  CHECK(torn.pressure() == Approx(-0.5e-5 * kappa).epsilon(1e-6));  // what is left once alpha > 0
}
