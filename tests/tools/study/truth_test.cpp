#include "tools/cli/study/truth.h"

#include <random>

#include <catch2/catch.hpp>

#include "engine/scene/reader.h"
#include "tools/cli/study/errors.h"
#include "tools/cli/study/resample.h"

namespace firn {
namespace {

/// A cloud of points in the unit cube of that dimension, about `spacing` apart, with a field on it.
template <class Field>
BodyPoints cloud(int dimension, double spacing, Field&& field, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const int n = static_cast<int>(std::round(1 / spacing));
  const auto count = static_cast<std::size_t>(std::pow(n, dimension));
  BodyPoints out(count);
  for (std::size_t p = 0; p < count; ++p) {
    Vec3 X = Vec3::Zero();
    std::size_t rest = p;
    for (int d = 0; d < dimension; ++d, rest /= static_cast<std::size_t>(n))
      X[d] = (static_cast<double>(rest % static_cast<std::size_t>(n)) + unit(random)) * spacing;
    out.start[p] = X;
    out.mass[p] = 1;
    field(X, out, p);
  }
  return out;
}

const auto kQuadratic = [](const Vec3& X, BodyPoints& out, std::size_t p) {
  out.displacement[p] = Vec3(1 + X[0] * X[0] - 2 * X[0] * X[1], X[1], X[2] * X[2] + X[0]);
  out.velocity[p] = X;
  out.stress[p] = X * X.transpose();
};

TEST_CASE("a field that varies quadratically is resampled as it is") {
  for (const int dimension : {1, 2, 3}) {
    const BodyPoints known = cloud(dimension, 0.1, kQuadratic);
    const BodyPoints wanted = cloud(dimension, 0.15, kQuadratic, 2);
    BodyPoints found = wanted;
    found.displacement.assign(found.size(), Vec3::Zero());
    found.stress.assign(found.size(), Eigen::Matrix3d::Zero());
    Resampler(known, dimension).fill(found);
    const auto norms = errors({found}, {wanted});
    // Rounding, times how badly random places determine a quadratic at the surface.
    CHECK(*norms[kDisplacement].max < 1e-11);
    CHECK(*norms[kStress].max < 1e-11);
  }
}

TEST_CASE("resampling a smooth field is of the third order") {
  const auto smooth = [](const Vec3& X, BodyPoints& out, std::size_t p) {
    out.displacement[p] = Vec3(std::sin(3 * X[0]) * std::cos(2 * X[1]), 0, 0);
  };
  const auto error = [&](double spacing) {
    const BodyPoints wanted = cloud(2, 0.05, smooth, 3);
    BodyPoints found = wanted;
    Resampler(cloud(2, spacing, smooth), 2).fill(found);
    return *errors({found}, {wanted})[kDisplacement].l2;
  };
  CHECK(error(0.05) / error(0.025) > 6);  // 8, but that the places are random
}

TEST_CASE("few or regular points are resampled without a singular fit") {
  BodyPoints one(1), out(1);
  one.displacement[0] = Vec3(1, 2, 3);
  out.start[0] = Vec3(5, 5, 5);
  Resampler(one, 3).fill(out);
  CHECK(out.displacement[0] == Vec3(1, 2, 3));
  BodyPoints row(20);  // on a line in the plane: nothing says what happens beside it
  for (std::size_t p = 0; p < 20; ++p) {
    row.start[p] = Vec3(0.1 * static_cast<double>(p), 0, 0);
    row.displacement[p] = Vec3(row.start[p].x(), 0, 0);
  }
  out.start[0] = Vec3(0.55, 0, 0);
  Resampler(row, 2).fill(out);
  CHECK(out.displacement[0].x() == Approx(0.55).epsilon(1e-9));
}

TEST_CASE("errors are relative, weighted by mass, and none where there is no truth") {
  BodyPoints truth(2), run(2);
  truth.mass = run.mass = {1, 3};
  truth.displacement = {Vec3(2, 0, 0), Vec3(0, 0, 2)};
  run.displacement = {Vec3(2, 1, 0), Vec3(0, 0, 2)};
  const auto norms = errors({run}, {truth});
  CHECK(*norms[kDisplacement].l2 == Approx(std::sqrt(1.0 / 16)));
  CHECK(*norms[kDisplacement].max == Approx(0.5));
  CHECK_FALSE(norms[kVelocity].l2);
  run.displacement[0].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(errors({run}, {truth})[kDisplacement].l2);
}

/// Levels whose error is `c h^order`.
std::vector<std::vector<BodyPoints>> levels(const std::vector<double>& sizes, double order, double c) {
  std::vector<std::vector<BodyPoints>> out;
  for (const double h : sizes)
    out.push_back({cloud(2, 0.1, [&](const Vec3& X, BodyPoints& points, std::size_t p) {
      const double error = c * std::pow(h, order);
      points.displacement[p] = (1 + error) * Vec3(1 + X[0], X[1], 0);
      points.velocity[p] = points.displacement[p];
      points.stress[p] = (1 + error) * Eigen::Matrix3d::Identity();
    })});
  return out;
}

TEST_CASE("Richardson's extrapolation finds the order and what the runs tend to") {
  for (const double order : {1.0, 1.5, 2.0}) {
    const FinestRuns form{{0.2, 0.1, 0.05}, {}};
    const auto truth = finest_truth(form, levels(form.cell_sizes, order, 0.3), 2);
    CHECK(*truth->order(kDisplacement) == Approx(order).epsilon(1e-6));
    const auto exact = levels({0.0}, order, 0.3)[0];
    CHECK(*errors(truth->at(exact), exact)[kDisplacement].l2 < 1e-9);
    // The grid convergence index: 1.25 times the finest run's own error.
    const double finest = 0.3 * std::pow(0.05, order);
    CHECK(truth->uncertainty(kDisplacement) == Approx(1.25 * finest).epsilon(0.02));
  }
}

TEST_CASE("levels that do not converge, or only two, are not extrapolated, and trusted less") {
  const auto exact = levels({0.0}, 1, 0)[0];
  for (const auto& [sizes, order] :
       {std::pair{std::vector{0.2, 0.1, 0.05}, 0.1}, std::pair{std::vector{0.1, 0.05}, 2.0}}) {
    const FinestRuns form{sizes, {}};
    const auto truth = finest_truth(form, levels(sizes, order, 0.1), 2);
    const double finest = 0.1 * std::pow(0.05, order), before = 0.1 * std::pow(0.1, order);
    CHECK(*errors(truth->at(exact), exact)[kDisplacement].l2 == Approx(finest).epsilon(0.01));
    CHECK(truth->uncertainty(kDisplacement) == Approx(3 * (before - finest)).epsilon(0.15));
  }
}

Plan bar_plan(const std::string& model) {
  return make_plan(read_scene_text(R"(
[simulation]
dimension = 2
cell_size = 0.1
duration = 1
[materials.m]
model = ")" + model + R"("
density = 2
youngs_modulus = 10
poissons_ratio = 0.3
[[bodies]]
name = "bar"
material = "m"
shape = { type = "box", min = [0, 0, 0], max = [1, 1, 0] }
)",
                                   "a.toml"));
}

TEST_CASE("velocity and stress of a closed form follow from its displacement") {
  const Plan plan = bar_plan("neo_hookean");
  const ClosedForm form{{{{0, "0.1 * X * t^2"}, {0, "-0.05 * Y * sin(t)"}, {}}}};
  const double T = 0.7;
  const auto truth = closed_form_truth(form, plan, T);
  const std::vector<BodyPoints> run{cloud(2, 0.25, [](const Vec3&, BodyPoints&, std::size_t) {})};
  const BodyPoints points = truth->at(run)[0];
  const double f0 = 1 + 0.1 * T * T, f1 = 1 - 0.05 * std::sin(T), J = f0 * f1;
  const double mu = 10 / 2.6, lam = 3 / (1.3 * 0.4);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Vec3& X = points.start[p];
    CHECK((points.velocity[p] - Vec3(0.2 * T * X[0], -0.05 * std::cos(T) * X[1], 0)).norm() < 1e-10);
    CHECK(points.stress[p](0, 0) == Approx((mu * (f0 * f0 - 1) + lam * std::log(J)) / J).epsilon(1e-9));
    CHECK(points.stress[p](1, 1) == Approx((mu * (f1 * f1 - 1) + lam * std::log(J)) / J).epsilon(1e-9));
    CHECK(std::abs(points.stress[p](0, 1)) < 1e-9);
  }
  CHECK(truth->knows(kStress));
  CHECK(truth->uncertainty(kStress) == 0);
  // What flows has no stress that its displacement would tell.
  CHECK_FALSE(closed_form_truth(form, bar_plan("snow_stomakhin_2013"), T)->knows(kStress));
}

}  // namespace
}  // namespace firn
