// What Buzzi, Pedroso & Giacomini 2008 warn of, sections 5.4 and 5.5, must go as wrong as they say. The
// mistakes are not in the engine but in a bar of its own, USF with FLIP and additive strain, which without
// them gives what the engine gives (vibration_test.cpp).
#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/grid/kernel.h"

using firn::LinearKernel;

namespace {

constexpr double kSpeed = 0.1, kDt = 1e-3;

enum class Mistake {
  none,
  extrapolation,  // momentum of a node is its mass times the sum of S v_p (equation 39)
  boundary        // the fixed node's velocity is zero for the strain, its momentum is not (figure 22)
};

struct Bar {
  double youngs_modulus, h, volume;  // density 1, so that mass = volume
  Mistake mistake;
  std::vector<double> x, v, strain;

  Bar(double E, int points, int cells, Mistake m)
      : youngs_modulus(E), h(1.0 / cells), volume(1.0 / points), mistake(m) {
    for (int p = 0; p < points; ++p) {
      x.push_back((p + 0.5) / points);
      v.push_back(points == 1 ? kSpeed : kSpeed * std::sin(std::numbers::pi / 2 * x.back()));
      strain.push_back(0);
    }
  }

  /// Calls f(node, weight, slope) for the two nodes of point p.
  template <class F>
  void for_nodes(std::size_t p, F&& f) const {
    const double first = LinearKernel::first_node(x[p] / h, 0.0);
    double w[2], dw[2];
    LinearKernel::weights(x[p] / h - first, 0.0, w, dw);
    for (std::size_t n = 0; n < 2; ++n) f(static_cast<std::size_t>(first) + n, w[n], dw[n] / h);
  }

  void step() {
    const std::size_t nodes = static_cast<std::size_t>(2 / h) + 2;  // the bar stays below x = 2
    std::vector<double> m(nodes), q(nodes), sum_v(nodes), force(nodes);
    for (std::size_t p = 0; p < x.size(); ++p)
      for_nodes(p, [&](std::size_t n, double S, double) {
        m[n] += S * volume;
        q[n] += S * volume * v[p];
        sum_v[n] += S * v[p];
      });
    if (mistake == Mistake::extrapolation)
      for (std::size_t n = 0; n < nodes; ++n) q[n] = m[n] * sum_v[n];
    if (mistake != Mistake::boundary) q[0] = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      for_nodes(p, [&](std::size_t n, double, double G) {
        if (n > 0) strain[p] += kDt * G * q[n] / m[n];
      });
      for_nodes(
          p, [&](std::size_t n, double, double G) { force[n] -= volume * youngs_modulus * strain[p] * G; });
    }
    force[0] = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      double rate = 0, velocity = 0;
      for_nodes(p, [&](std::size_t n, double S, double) {
        rate += S * force[n] / m[n];
        velocity += S * (q[n] + kDt * force[n]) / m[n];
      });
      v[p] += kDt * rate;
      x[p] += kDt * velocity;
    }
  }

  double mean_velocity() const {
    double sum = 0;
    for (const double vp : v) sum += vp;
    return sum / static_cast<double>(v.size());
  }
  double energy() const {
    double sum = 0;
    for (std::size_t p = 0; p < x.size(); ++p)
      sum += volume * (v[p] * v[p] + youngs_modulus * strain[p] * strain[p]) / 2;
    return sum;
  }
};

struct Run {
  double error = 0,
         energy_deviation = 0;     // of the mean velocity (equation 38) and of the energy, the largest
  double lowest = 1, highest = 0;  // of the first point's place
  double period = 0;               // s, the mean one
};

Run run(Bar bar, double mean, double w) {
  Run out;
  const double start = bar.energy();
  double last = bar.mean_velocity(), first_crossing = 0, last_crossing = 0;
  int crossings = 0;
  for (int n = 1; n <= 10000; ++n) {
    bar.step();
    const double t = n * kDt, v = bar.mean_velocity(), v_a = mean * std::cos(w * t);
    out.error = std::max(out.error, std::abs(v_a - v) / (1 + std::abs(v_a)));
    out.energy_deviation = std::max(out.energy_deviation, std::abs(bar.energy() / start - 1));
    out.lowest = std::min(out.lowest, bar.x[0]);
    out.highest = std::max(out.highest, bar.x[0]);
    if (last > 0 && v <= 0) {
      last_crossing = t - kDt * v / (v - last);
      if (crossings++ == 0) first_crossing = last_crossing;
    }
    last = v;
  }
  out.period = (last_crossing - first_crossing) / (crossings - 1);
  return out;
}

Run point(Mistake mistake) {
  const double w = 2 * std::numbers::pi;
  return run(Bar(w * w, 1, 1, mistake), kSpeed, w);
}
Run bar(int points, Mistake mistake) {
  return run(Bar(10, points, points, mistake), kSpeed * 2 / std::numbers::pi,
             std::numbers::pi / 2 * std::sqrt(10.0));
}

}  // namespace

TEST_CASE("without a mistake the controls' bar gives the known figures") {
  const Run one = point(Mistake::none);
  CHECK(one.error == Approx(3.242e-4).epsilon(2e-4));
  CHECK(one.period == Approx(1).epsilon(1e-5));
  CHECK(bar(7, Mistake::none).error == Approx(2.66e-2).epsilon(2e-3));
  CHECK(bar(13, Mistake::none).error == Approx(8.39e-3).epsilon(2e-3));
  CHECK(bar(13, Mistake::none).energy_deviation == Approx(2.6e-3).margin(1e-4));
}

TEST_CASE(
    "control: momentum from a mass and a velocity that are both weighted makes a point swing sqrt(2) times "
    "slower") {
  const Run wrong = point(Mistake::extrapolation);
  CHECK(wrong.period == Approx(std::sqrt(2.0)).epsilon(2e-3));
  CHECK(wrong.error == Approx(0.182).epsilon(5e-3));
}

TEST_CASE("control: the same makes a bar unstable") {
  CHECK(bar(13, Mistake::extrapolation).energy_deviation == Approx(8.5).epsilon(0.01));
  CHECK(bar(7, Mistake::extrapolation).energy_deviation == Approx(27).epsilon(0.02));
}

TEST_CASE(
    "control: a wall that holds the velocity but not the momentum lets the points next to it move too far") {
  const Run right = bar(7, Mistake::none), wrong = bar(7, Mistake::boundary);
  CHECK(wrong.error == Approx(right.error).epsilon(0.02));
  CHECK(right.lowest == Approx(0.06917).margin(1e-5));
  CHECK(right.highest == Approx(0.07367).margin(1e-5));
  CHECK(wrong.lowest == Approx(0.06784).margin(1e-5));
  CHECK(wrong.highest == Approx(0.07480).margin(1e-5));
}
