#include <catch2/catch.hpp>

#include "engine/passes/material_pass.h"
#include "engine/passes/p2g.h"
#include "engine/passes/sort.h"
#include "engine/passes/totals.h"
#include "materials/model_info.h"
#include "materials/registry.h"
#include "tests/support/random_batch.h"

using namespace firn;

namespace {

constexpr double kCell = 0.1;

// The energy after the grid's nodes moved by `step` times a unit vector each, which deforms every particle by
// F <- (1 + sum u_i grad S) F: what the internal force must be the derivative of.
template <int D>
struct Problem {
  std::vector<Batch<double, D>> batches;
  BlockLayout<D> layout;
  GridNodes<double, D> grid;

  explicit Problem(ColumnSet columns) {
    batches.push_back(test::random_batch<double, D>(400, kCell, 5, columns));
    Sorter<QuadraticKernel, double, D>().sort(batches, kCell, layout, ColumnSet::all());
  }

  template <class Model>
  double energy(const Model& model, std::size_t node, int axis, double step) {
    auto& t = batches[0].particles;
    double sum = 0;
    for (std::size_t block = 0; block < layout.occupied(); ++block) {
      const auto [first, last] = batches[0].range(block);
      for (std::size_t p = first; p < last; ++p) {
        const Stencil<QuadraticKernel, double, D> stencil(t.template view<Column::position>().load(p), 0,
                                                          1 / kCell, layout.coord(block));
        typename Model::template Point<double, D> point;
        point.visit([&](auto column, auto& value) { value = t.template view<column()>().load(p); });
        auto u = Matrix<double, D>::zero();
        stencil.for_each([&](std::size_t scratch, double, const auto& gradient, const auto&) {
          if (global(block, scratch) != node) return;
          for (int d = 0; d < D; ++d) u(axis, d) += step * gradient[d] / kCell;
        });
        point.F_E = point.F_E + u * point.F_E;
        sum += t.template view<Column::volume>().load(p) * model.energy(point);
      }
    }
    return sum;
  }

  // One number for a node, from the block and scratch it is seen in.
  std::size_t global(std::size_t block, std::size_t scratch) {
    std::size_t found = 0;
    Scratch<std::size_t, D> numbers;
    std::size_t s = 0;
    numbers.for_each([&](std::size_t&, int neighbour, int local) {
      if (s++ == scratch)
        found = layout.neighbours(block)[static_cast<std::size_t>(neighbour)] * kBlockNodes<D> +
                static_cast<std::size_t>(local);
    });
    return found;
  }
};

template <class Model, int D>
void check_force(const Model& model) {
  Problem<D> problem(kTransferColumns | PicTransfer::columns | Model::template Point<double, D>::columns);
  auto& t = problem.batches[0].particles;
  material_pass(model, t, 0.0);
  for (std::size_t p = 0; p < t.size(); ++p)
    t.template view<Column::velocity>().store(p, Vector<double, D>::zero());
  p2g<QuadraticKernel, PicTransfer, double, D>(std::span<const Batch<double, D>>(problem.batches),
                                               problem.layout, kCell, 1.0, problem.grid);
  double largest = 0;
  for (std::size_t block = 0; block < problem.layout.occupied(); ++block)
    for (const auto& node : problem.grid.nodes.block(block)) largest = std::max(largest, norm(node.v));
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t n = (k * 7) % kBlockNodes<D>;
    const int axis = static_cast<int>(k) % D;
    const std::size_t block = k % problem.layout.occupied();
    // Central differences: error step^2 against rounding eps U / step; the best of both is near 1e-6 of the
    // force.
    const double step = 1e-6 * kCell;
    const std::size_t global = block * kBlockNodes<D> + n;
    const double slope =
        (problem.energy(model, global, axis, step) - problem.energy(model, global, axis, -step)) / (2 * step);
    const double force = problem.grid.nodes.block(block)[n].v[axis];
    INFO("node " << global << " axis " << axis);
    CHECK(force == Approx(-slope).margin(1e-6 * std::max(largest, 1.0)));
  }
  CHECK(largest > 1);  // there was a force to compare
}

ParameterValues values(const char* model) {
  ParameterValues out;
  for (const Parameter& p : find_model(model)->parameters)
    out[std::string(p.name)] = p.required() ? 1000 : p.default_value;
  out["youngs_modulus"] = 1000;
  out["poissons_ratio"] = 0.3;
  out["density"] = 1000;
  return out;
}

}  // namespace

TEST_CASE(
    "the grid's internal force is the negative derivative of the stored energy, for every elastic model") {
  for (const ModelInfo& model : models()) {
    if (model.yield != "none") continue;
    INFO(model.name);
    const Material material = make_material(model.name, values(model.name.data()));
    std::visit([](const auto& m) { check_force<std::remove_cvref_t<decltype(m)>, 2>(m); }, material);
    std::visit([](const auto& m) { check_force<std::remove_cvref_t<decltype(m)>, 3>(m); }, material);
  }
}

TEST_CASE("the stress of a plastic model depends on F_E and the hardened moduli only") {
  // Same F_E, different F_P with the same determinant: the same stress to the last bit.
  const Material material = make_material("snow_stomakhin_2013", values("snow_stomakhin_2013"));
  const auto& snow = std::get<SnowStomakhin2013>(material);
  PlasticPoint<double, 3> a{Matrix<double, 3>::identity(), Matrix<double, 3>::identity()};
  a.F_E(0, 1) = 0.004;
  PlasticPoint<double, 3> b = a;
  b.F_P(1, 2) = 0.5;  // a shear: det F_P stays 1
  const auto tau_a = snow.update(a, 0.0).tau, tau_b = snow.update(b, 0.0).tau;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) CHECK(tau_a(i, j) == tau_b(i, j));
}
