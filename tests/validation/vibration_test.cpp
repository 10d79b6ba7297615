// The two vibration problems of Buzzi, Pedroso & Giacomini 2008 (Caveats on the implementation of the
// generalized material point method), sections 5.1 and 5.3, against closed forms. Their bars keep their
// volume and have sigma = E eps with eps the integral of dv/dx; here that is the Hencky energy without
// lateral strain, tau = E ln F. In one step ln F grows by ln(1 + dt dv/dx), which is less than dt dv/dx by
// half its square: over a time T the strain lags by dt T <(dv/dx)^2> / 2.
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/simulated.h"

using namespace firn;
using firn::test::Simulated;

namespace {

constexpr double kSpeed = 0.1;  // m/s, at the start; the paper does not say

struct Rod {
  const char *kernel, *order;
  double youngs_modulus;  // Pa; length 1 m, density 1 kg/m^3
  int cells, points;      // of the rod

  std::string scene() const {
    return fmt::format(R"(
[simulation]
dimension = 1
cell_size = {}
duration = 100
precision = "double"
kernel = "{}"
transfer = "flip"
flip_ratio = 1
stress_order = "{}"
[materials.rod]
model = "stvk_hencky"
density = 1
youngs_modulus = {}
poissons_ratio = 0
[[bodies]]
name = "rod"
material = "rod"
shape = {{ type = "box", min = [0, 0, 0], max = [1, 0, 0] }}
[domain]
min = [0, 0, 0]
max = [100, 0, 0]
contact = "sticky"
)",
                       1.0 / cells, kernel, order, youngs_modulus);
  }
};

struct Result {
  double error = 0;             // of the mean velocity, equation 38, the largest
  double energy_deviation = 0;  // |E/E0 - 1|, the largest
  double energy = 0;            // E/E0 at the end
  double mean_velocity = 0;     // m/s at the end
};

/// Points evenly spaced, with velocity kSpeed * shape(x); `exact`: the mean velocity at a time.
template <class Shape, class Exact>
Result vibrate(const Rod& rod, double dt, double duration, Shape&& shape, Exact&& exact) {
  const auto spread = [&](std::vector<Seeds>& seeds) {
    Seeds even;
    for (int p = 0; p < rod.points; ++p) {
      const double x = (p + 0.5) / rod.points;
      even.position.push_back({x, 0, 0});
      even.velocity.push_back({kSpeed * shape(x), 0, 0});
    }
    even.volume = 1;
    seeds = {even};
  };
  Simulated s(rod.scene(), {}, FIRN_TEST_DATA, spread);
  const auto energy = [](const FrameTotals& t) { return t.kinetic + t.elastic; };
  const double start = energy(s.totals());
  Result out;
  const int steps = static_cast<int>(std::round(duration / dt));
  for (int n = 1; n <= steps; ++n) {
    s->step(dt, dt);
    const FrameTotals t = s.totals();
    const double v = t.momentum[0] / t.mass, v_a = exact(n * dt);
    out.error = std::max(out.error, std::abs(v_a - v) / (1 + std::abs(v_a)));
    out.energy = energy(t) / start;
    out.energy_deviation = std::max(out.energy_deviation, std::abs(out.energy - 1));
    out.mean_velocity = v;
  }
  return out;
}

Result single_point(const char* kernel, const char* order, double dt, double duration) {
  constexpr double w = 2 * std::numbers::pi;
  return vibrate(
      {kernel, order, w * w, 1, 1}, dt, duration, [](double) { return 1.0; },
      [](double t) { return kSpeed * std::cos(w * t); });
}

Result bar(const char* kernel, const char* order, int points, int cells, double dt, double duration) {
  const double w = std::numbers::pi / 2 * std::sqrt(10.0);
  return vibrate(
      {kernel, order, 10, cells, points}, dt, duration,
      [](double x) { return std::sin(std::numbers::pi / 2 * x); },
      [=](double t) { return kSpeed * 2 / std::numbers::pi * std::cos(w * t); });
}

}  // namespace

// The figures were computed independently, with additive strain; "lag" is the difference above as a part of
// the strain's amplitude v0 / w, over 10 s.
TEST_CASE("a single point vibrates as the order and the kernel make it, to three digits") {
  struct Row {
    const char *kernel, *order;
    double dt, error_1s, error_10s, energy;
  };
  const Row row = GENERATE(Row{"linear", "usf", 0.1, 3.83e-2, 1.19e-1, 0.8965},  //
                           Row{"linear", "usl", 0.1, 8.14e-2, 9.09e-2, 0},       //
                           Row{"linear", "musl", 0.1, 2.87e-2, 7.13e-2, 1.445},  //
                           Row{"gimp", "usf", 0.1, 3.32e-2, 7.18e-2, 0.778},     //
                           Row{"gimp", "usl", 0.1, 1.09e-1, 1.09e-1, 0},         //
                           Row{"linear", "usf", 1e-2, 3.22e-3, 4.15e-3, 0.99935},
                           Row{"linear", "usl", 1e-2, 1.64e-2, 7.83e-2, 0.01928},
                           Row{"linear", "musl", 1e-2, 3.12e-3, 3.12e-3, 1.00065},
                           Row{"gimp", "usf", 1e-2, 2.47e-3, 2.68e-2, 1.0120},  //
                           Row{"gimp", "usl", 1e-2, 3.00e-2, 9.06e-2, 1.5e-5},
                           Row{"linear", "usf", 1e-3, 3.149e-4, 3.242e-4, 0.999999},
                           Row{"linear", "usl", 1e-3, 1.80e-3, 1.63e-2, 0.67381},
                           Row{"linear", "musl", 1e-3, 3.139e-4, 3.139e-4, 1.000001},
                           Row{"gimp", "usf", 1e-3, 2.16e-3, 3.04e-2, 1.0012},
                           Row{"gimp", "usl", 1e-3, 4.66e-3, 3.61e-2, 0.45584},
                           Row{"linear", "usf", 1e-4, 3.142e-5, 3.152e-5, 1},
                           Row{"linear", "usl", 1e-4, 1.82e-4, 1.78e-3, 0.96128});
  CAPTURE(row.kernel, row.order, row.dt);
  const Result one = single_point(row.kernel, row.order, row.dt, 1);
  const Result ten = single_point(row.kernel, row.order, row.dt, 10);
  const double lag = row.dt * 10 * (kSpeed * kSpeed / 2) / 2 / (kSpeed / (2 * std::numbers::pi));
  const double tolerance = lag + 0.012;  // a digit of the rounded errors, and what the lag does to a maximum
  CHECK(one.error == Approx(row.error_1s).epsilon(tolerance));
  CHECK(ten.error == Approx(row.error_10s).epsilon(tolerance));
  // Energy does not depend on where the strain is counted from, but on the strain's own size it does.
  CHECK(ten.energy == Approx(row.energy).epsilon(0.1 * lag + 1e-5).margin(1e-6));
}

TEST_CASE("a single point: the closed forms of its energy and velocity") {
  const double w = 2 * std::numbers::pi;
  // A step of USL multiplies the energy by 1 - w^2 dt^2 L/x, L/x being 1 but for the amplitude.
  CHECK(single_point("linear", "usl", 1e-3, 10).energy ==
        Approx(std::pow(1 - w * w * 1e-6, 1e4)).epsilon(2e-4));
  for (const double dt : {1e-2, 1e-3}) {
    CHECK(single_point("linear", "usf", dt, 10).energy_deviation == Approx(w * dt / 2).epsilon(0.03));
    const double th = 2 * std::asin(w * dt / 2);
    const double v = kSpeed * std::cos((std::round(1 / dt) + 0.5) * th) / std::cos(th / 2);
    CHECK(single_point("linear", "usf", dt, 1).mean_velocity == Approx(v).epsilon(1e-7));
  }
}

TEST_CASE("a bar vibrates as its points and nodes make it") {
  struct Row {
    const char *kernel, *order;
    int points, cells;
    double error_period, error, energy;  // 0: no figure
  };
  const Row row = GENERATE(
      Row{"linear", "usf", 13, 13, 1.61e-3, 8.39e-3, 0},  //
      Row{"linear", "usf", 7, 7, 3.27e-3, 2.66e-2, 0}, Row{"linear", "usf", 3, 3, 1.51e-2, 1.07e-1, 0},
      Row{"linear", "usf", 3, 1, 8.03e-2, 1.20e-1, 0}, Row{"linear", "usf", 7, 1, 7.74e-2, 1.19e-1, 0},
      Row{"gimp", "usf", 13, 13, 0, 1.32e-2, 0},                                             //
      Row{"linear", "usl", 13, 13, 0, 0, 0.9966}, Row{"gimp", "usl", 13, 13, 0, 0, 0.9905},  //
      Row{"linear", "usl", 3, 1, 0, 0, 0.9335});
  CAPTURE(row.kernel, row.order, row.points, row.cells);
  const Result period = bar(row.kernel, row.order, row.points, row.cells, 1e-3, 1.265);
  const Result all = bar(row.kernel, row.order, row.points, row.cells, 1e-3, 10);
  // Three digits, and the lag: here half a percent of the strain.
  if (row.error_period > 0) CHECK(period.error == Approx(row.error_period).epsilon(0.01));
  if (row.error > 0) CHECK(all.error == Approx(row.error).epsilon(0.01));
  if (row.energy > 0) CHECK(all.energy == Approx(row.energy).margin(1e-4));
}

TEST_CASE("points alone do not make a bar more accurate, points and nodes together do") {
  const auto error = [](int points, int cells) {
    return bar("linear", "usf", points, cells, 1e-3, 10).error;
  };
  const double coarse = error(3, 1);
  CHECK(error(7, 1) > 0.95 * coarse);
  CHECK(error(3, 3) < 0.95 * coarse);
  CHECK(error(7, 7) < 0.3 * coarse);
  CHECK(error(13, 13) < 0.1 * coarse);
}
