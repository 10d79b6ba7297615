// The cycle of the method stage by stage, as the documents list it, in plain loops over all particles and
// nodes: Buzzi, Pedroso & Giacomini 2008, figures 2 (USF) and 3 (USL), and the ten steps of the lecture on
// GIMP. MUSL after Sulsky, Zhou & Schreyer 1995. Nothing here is shared with the program but the scene.
#include <map>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "tests/support/simulated.h"

using Eigen::Matrix2d;
using Eigen::Vector2d;
using firn::MaterialPoints;
using firn::test::Simulated;

namespace {

constexpr double h = 0.5, kDensity = 2, kLambda = 3, kMu = 4, kGravity = -9.81;

struct Point {
  Vector2d x, v;
  Matrix2d F = Matrix2d::Identity(), stress = Matrix2d::Zero();  // Cauchy's
  double m, V0;
};

using NodeIndex = std::pair<int, int>;
struct GridNode {
  double m = 0;
  Vector2d q = Vector2d::Zero(), f = Vector2d::Zero(), v = Vector2d::Zero(), a = Vector2d::Zero();
};
using Grid = std::map<NodeIndex, GridNode>;

double hat(double r) {
  return std::max(0.0, 1 - std::abs(r) / h);
}
double slope(double r) {
  return std::abs(r) >= h ? 0 : r > 0 ? -1 / h : 1 / h;
}

/// Calls f(node, S, gradient of S) for the four nodes of the particle's cell.
template <class F>
void for_nodes(const Point& p, F&& f) {
  const int i0 = static_cast<int>(std::floor(p.x[0] / h)), j0 = static_cast<int>(std::floor(p.x[1] / h));
  for (int i = i0; i <= i0 + 1; ++i)
    for (int j = j0; j <= j0 + 1; ++j) {
      const double rx = p.x[0] - i * h, ry = p.x[1] - j * h;
      f(NodeIndex{i, j}, hat(rx) * hat(ry), Vector2d(slope(rx) * hat(ry), hat(rx) * slope(ry)));
    }
}

class Cycle {
 public:
  std::vector<Point> points;
  double dt;

  void usl() {
    project();
    solve();
    strain();  // from the same velocities as the places, so either may come first
    move();
  }
  void usf() {
    project();
    for (auto& [index, node] : grid_) node.v = held(index, node.q / node.m);
    strain();
    solve();
    move();
  }
  void musl() {
    project();
    solve();
    move_velocities();
    // The new velocities on the grid, at the old places.
    for (auto& [index, node] : grid_) node.q.setZero();
    for (const Point& p : points)
      for_nodes(p, [&](NodeIndex i, double S, const Vector2d&) { grid_[i].q += S * p.m * p.v; });
    std::map<NodeIndex, Vector2d> moving;
    for (auto& [index, node] : grid_) {
      moving[index] = node.v;
      node.v = held(index, node.q / node.m);
    }
    strain();
    for (auto& [index, node] : grid_) node.v = moving[index];
    move_places();
  }

 private:
  /// A wall below y = 0: what touches it stays where it is.
  static Vector2d held(NodeIndex index, const Vector2d& v) {
    return index.second <= 0 ? Vector2d::Zero() : v;
  }

  void project() {
    grid_.clear();
    for (const Point& p : points)
      for_nodes(p, [&](NodeIndex i, double S, const Vector2d&) {
        grid_[i].m += S * p.m;
        grid_[i].q += S * p.m * p.v;
      });
  }
  /// Forces of the present stress, accelerations and velocities at the end of the step, zero at the wall.
  void solve() {
    for (const Point& p : points)
      for_nodes(p, [&](NodeIndex i, double S, const Vector2d& G) {
        grid_[i].f += -p.V0 * p.F.determinant() * p.stress * G + S * p.m * Vector2d(0, kGravity);
      });
    for (auto& [index, node] : grid_) {
      const Vector2d before = held(index, node.q / node.m);
      node.v = held(index, node.q / node.m + dt * node.f / node.m);
      node.a = (node.v - before) / dt;
    }
  }
  void move_velocities() {
    for (Point& p : points)
      for_nodes(p, [&](NodeIndex i, double S, const Vector2d&) { p.v += S * dt * grid_[i].a; });
  }
  void move_places() {
    for (Point& p : points) {
      Vector2d v = Vector2d::Zero();
      for_nodes(p, [&](NodeIndex i, double S, const Vector2d&) { v += S * grid_[i].v; });
      p.x += dt * v;
    }
  }
  void move() {
    move_velocities();
    move_places();
  }
  /// With the weights of the places where the step began.
  void strain() {
    for (Point& p : points) {
      Matrix2d L = Matrix2d::Zero();
      for_nodes(p, [&](NodeIndex i, double, const Vector2d& G) { L += grid_[i].v * G.transpose(); });
      p.F = (Matrix2d::Identity() + dt * L) * p.F;
      const double J = p.F.determinant();
      p.stress = (kLambda * std::log(J) * Matrix2d::Identity() +
                  kMu * (p.F * p.F.transpose() - Matrix2d::Identity())) /
                 J;
    }
  }

  Grid grid_;
};

// Lame's constants of the scene below are kLambda and kMu.
const std::string kScene = R"(
[simulation]
dimension = 2
cell_size = 0.5
duration = 1
precision = "double"
kernel = "linear"
transfer = "flip"
flip_ratio = 1
mass_cutoff = 0
[gravity]
acceleration = [0, -9.81, 0]
[materials.m]
model = "neo_hookean"
density = 2
youngs_modulus = 9.714285714285714
poissons_ratio = 0.21428571428571427
[[bodies]]
name = "body"
material = "m"
shape = { type = "box", min = [0.1, 0.05, 0], max = [1.4, 1.2, 0] }
particles_per_cell = 2
velocity = ["1 + y", "-x * y", 0]
[domain]
min = [-100, 0, 0]
max = [100, 100, 0]
contact = "sticky"
)";

TEST_CASE("steps of each order give the numbers of plain loops over particles and nodes, stage by stage") {
  const std::string order = GENERATE("usl", "usf", "musl");
  CAPTURE(order);
  Simulated s(kScene, {"simulation.stress_order=" + order});
  Cycle cycle;
  cycle.dt = 0.01;
  const MaterialPoints start = s->material_points();
  for (std::size_t p = 0; p < start.mass.size(); ++p) {
    Point& point = cycle.points.emplace_back();
    point.x = start.position[p].head<2>();
    point.v = start.velocity[p].head<2>();
    point.m = start.mass[p];
    point.V0 = point.m / kDensity;
  }
  REQUIRE(cycle.points.size() >= 9);
  // Long enough for particles to cross cells.
  for (int step = 0; step < 40; ++step) {
    s->step(cycle.dt);
    order == "usl" ? cycle.usl() : order == "usf" ? cycle.usf() : cycle.musl();
  }
  const MaterialPoints end = s->material_points();
  for (std::size_t p = 0; p < end.mass.size(); ++p) {
    const Point& point = cycle.points[p];
    CAPTURE(p, point.x, point.v);
    // Rounding in another order, for forty steps.
    CHECK((end.position[p].head<2>() - point.x).norm() < 1e-12);
    CHECK((end.velocity[p].head<2>() - point.v).norm() < 1e-10);
    CHECK((end.stress[p].topLeftCorner<2, 2>() - point.stress).norm() < 1e-10);
  }
}

}  // namespace
