#include <catch2/catch.hpp>
#include <tbb/cache_aligned_allocator.h>

#include "engine/passes/batch.h"
#include "engine/vector/isa.h"
#include "tests/support/random_batch.h"

using namespace firn;

namespace {

// Kernels load whole registers.
template <class Real, int D>
using Nodes = std::vector<Node<Real, D>, tbb::cache_aligned_allocator<Node<Real, D>>>;

/// Of whole blocks of nodes; the same whatever the instruction set.
template <class Real, int D>
SpeedBound speed_bound(std::span<const Node<Real, D>> nodes, Real lightest) {
  std::optional<SpeedBound> out;
  for (const Isa isa : kIsas) {
    if (!available(isa)) continue;
    SpeedBound bound;
    for (std::size_t n = 0; n < nodes.size(); n += kBlockNodes<D>)
      bound.join(kernel_table<Real, D>(isa).grid.speed_bound(&nodes[n].v[0], lightest));
    if (out) {
      REQUIRE(out->heavy == bound.heavy);
      REQUIRE(out->light == bound.light);
    }
    out = bound;
  }
  return *out;
}

/// Particles in a block, and the nodes of its scratch with their mass.
template <class Real, int D>
struct Cloud {
  std::vector<Stencil<QuadraticKernel, Real, D>> stencils;
  Nodes<Real, D> nodes = Nodes<Real, D>(Scratch<int, D>::kSize);
  Real lightest = std::numeric_limits<Real>::max();

  Cloud(std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> place(0.5, 4.4999), mass(-2, 2);
    for (std::size_t p = 0; p < count; ++p) {
      Vector<Real, D> x;
      for (int d = 0; d < D; ++d) x[d] = static_cast<Real>(place(random));
      stencils.emplace_back(x, Real(0), Real(1), BlockCoord<D>{});
      const Real m = static_cast<Real>(std::pow(10, mass(random)));
      lightest = std::min(lightest, m);
      stencils.back().for_each(
          [&](std::size_t node, Real w, const auto&, const auto&) { nodes[node].m += w * m; });
    }
  }

  double bound() const { return speed_bound<Real, D>(std::span(nodes), lightest).value(); }

  /// The largest velocity component of a particle.
  double fastest() const {
    double out = 0;
    for (const auto& stencil : stencils) {
      auto v = Vector<Real, D>::zero();
      stencil.for_each([&](std::size_t node, Real w, const auto&, const auto&) { v += w * nodes[node].v; });
      for (int d = 0; d < D; ++d) out = std::max(out, std::abs(static_cast<double>(v[d])));
    }
    return out;
  }
};

#define FIRN_PATH_KINDS ((class Real, int D), Real, D), (float, 2), (float, 3), (double, 2), (double, 3)

}  // namespace

TEMPLATE_TEST_CASE_SIG("no particle is faster than the bound, however fast the light nodes are", "[vector]",
                       FIRN_PATH_KINDS) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(-1, 1), any(0, 1);
  // w_i <= m_i / m_p and the sums hold to rounding: 3^D products of D weights.
  const double rounding = 100 * static_cast<double>(std::numeric_limits<Real>::epsilon());
  double tightest = 0;
  for (int n = 0; n < 2000; ++n) {
    Cloud<Real, D> cloud(1 + static_cast<std::size_t>(n % 7), random);
    // From alike to as fast as a node is light, in one direction or in any.
    const double power = any(random);
    const bool aligned = n % 2 == 0;
    for (auto& node : cloud.nodes)
      for (int d = 0; d < D; ++d)
        node.v[d] = static_cast<Real>((aligned ? 1 : unit(random)) *
                                      std::pow(static_cast<double>(node.m) + 1e-9, -power));
    const double bound = cloud.bound(), fastest = cloud.fastest();
    REQUIRE(fastest <= bound * (1 + rounding));
    tightest = std::max(tightest, fastest / bound);
  }
  CHECK(tightest > 0.8);  // and the bound is not far from what happens
}

TEMPLATE_TEST_CASE_SIG("a node that hardly any mass reaches hardly counts", "[vector]", FIRN_PATH_KINDS) {
  Nodes<Real, D> nodes(64);
  for (auto& node : nodes) node = {Vector<Real, D>::constant(Real(-2)), Real(1)};
  nodes[5] = {Vector<Real, D>::constant(Real(1e6)), Real(1e-9)};
  nodes[6] = {Vector<Real, D>::constant(std::numeric_limits<Real>::infinity()), Real(0)};  // not in use
  // 2, and 3^D times 1e6 * 1e-9 / 0.5.
  const double expected = 2 + kNeighbours<D> * 2e-3;
  CHECK(speed_bound<Real, D>(std::span(std::as_const(nodes)), Real(0.5)).value() ==
        Approx(expected).epsilon(1e-6));
}

TEMPLATE_TEST_CASE_SIG("bounds of blocks join to the bound of all", "[vector]", FIRN_PATH_KINDS) {
  std::mt19937 random(24);
  Cloud<Real, D> cloud(5, random);
  for (std::size_t n = 0; n < cloud.nodes.size(); ++n) cloud.nodes[n].v[0] = static_cast<Real>(n % 13);
  SpeedBound joined;
  for (std::size_t n = 0; n < cloud.nodes.size(); n += kBlockNodes<D>)
    joined.join(speed_bound<Real, D>(std::span(std::as_const(cloud.nodes)).subspan(n, kBlockNodes<D>),
                                     cloud.lightest));
  CHECK(joined.value() == cloud.bound());
}

TEMPLATE_TEST_CASE_SIG("a velocity that is not finite gives no finite bound", "[vector]", FIRN_PATH_KINDS) {
  using Limits = std::numeric_limits<Real>;
  for (const Real bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()})
    for (const Real mass : {Real(1e-6), Real(1e6)})  // light and heavy
      for (const std::size_t at : {0, 17, 63}) {
        Nodes<Real, D> nodes(64, {Vector<Real, D>::constant(Real(1)), Real(1)});
        nodes[at].v[D - 1] = bad;
        nodes[at].m = mass;
        REQUIRE_FALSE(std::isfinite(speed_bound<Real, D>(std::span(std::as_const(nodes)), Real(1)).value()));
      }
}
