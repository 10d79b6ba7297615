#include "tools/cli/bench_weights.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <string_view>

#include "engine/base/check.h"
#include "engine/passes/sort.h"
#include "tools/cli/bench_progress.h"
#include "tools/cli/bench_samples.h"
#include "tools/cli/bench_table.h"
#include "tools/cli/read_memory.h"
#include "tools/cli/weight_storage.h"

namespace firn {
namespace {

constexpr int kPerAxis = 2;        // particles in a cell, along each of its edges
constexpr double kH = 1, kDt = 1;  // what the numbers are does not matter, but that they stay of size one

/// A cube of `edge` cells, a particle somewhere in each eighth of a cell.
template <class Real>
Batch<Real, 3> cube(int edge) {
  const int n = kPerAxis * edge;
  Batch<Real, 3> batch{ParticleTable<Real, 3>(
                           {Column::position, Column::velocity, Column::mass, Column::volume, Column::stress},
                           static_cast<std::size_t>(power(n, 3))),
                       {}};
  auto& t = batch.particles;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto place = [&](int i) { return static_cast<Real>(kH * (i + unit(random)) / kPerAxis); };
  const auto number = [&] { return static_cast<Real>(unit(random) - 0.5); };
  for (std::size_t p = 0; p < t.size(); ++p) {
    const int i = static_cast<int>(p);
    t.template view<Column::position>().store(
        p, Vector<Real, 3>{place(i / (n * n)), place(i / n % n), place(i % n)});
    t.template view<Column::velocity>().store(p, Vector<Real, 3>{number(), number(), number()});
    t.template view<Column::mass>().store(p, Real(1) / power(kPerAxis, 3));
    t.template view<Column::volume>().store(p, Real(1) / power(kPerAxis, 3));
    t.template view<Column::stress>().store(
        p, Matrix<Real, 3>::diagonal(Vector<Real, 3>{number(), number(), number()}));
  }
  return batch;
}

/// Particles sorted by cell, and all that the passes write to.
template <class Kernel, class Real>
struct Body {
  std::vector<Batch<Real, 3>> batches;
  BlockLayout<3> layout;
  BlockArray<Node<Real, 3>, 3> grid;
  ParticleTable<Real, 3> out;

  explicit Body(int edge) : batches{cube<Real>(edge)}, out({Column::velocity, Column::affine}, size()) {
    Sorter<Kernel, Real, 3>().sort(batches, Real(kH), layout, batch().particles.columns());
    grid.reset(layout);
  }
  const Batch<Real, 3>& batch() const { return batches.front(); }
  std::size_t size() const { return batch().particles.size(); }
};

/// ns per particle.
struct Round {
  double weights = 0, p2g = 0, g2p = 0;
  double step() const { return weights + p2g + g2p; }
};

struct Measurement {
  std::string_view kernel, precision, weights;
  std::size_t particles = 0, stored_bytes = 0;
  std::vector<double> samples = {};  // ns of a step, by round
  Round best = {};
  double traffic = std::numeric_limits<double>::infinity();  // the best of all rounds
};

template <class F>
double ns_each(std::size_t particles, F&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / static_cast<double>(particles);
}

template <class Weights, class Kernel, class Real>
Round time_passes(Body<Kernel, Real>& body) {
  // All memory has been written before, as it has been in all steps of a run but the first.
  Weights weights(body.batch(), body.layout, Real(kH));
  Round round;
  if (Weights::stored_bytes > 0) round.weights = ns_each(body.size(), [&] { weights.prepare(); });
  round.p2g = ns_each(
      body.size(), [&] { scatter_with(weights, body.batch(), body.layout, Real(kH), Real(kDt), body.grid); });
  round.g2p = ns_each(
      body.size(), [&] { gather_with(weights, body.batch(), body.layout, Real(kH), body.grid, body.out); });
  return round;
}

/// To write as much as is stored and to read it once: what no code that stores weights can do without,
/// however fast it computes.
double time_traffic(std::size_t particles, std::size_t stored_bytes) {
  constexpr std::size_t kLineBytes = kLineNumbers * sizeof(std::uint64_t);
  std::vector<std::uint64_t> array((particles * stored_bytes + kLineBytes - 1) / kLineBytes * kLineNumbers);
  return ns_each(particles, [&] {
    std::fill(array.begin(), array.end(), 1);
    FIRN_CHECK(sum_of(array) == array.size());
  });
}

constexpr std::string_view kAsInFirn = "recomputed";

class WeightsBench {
 public:
  explicit WeightsBench(int particles)
      : edge_(std::max(1, static_cast<int>(std::lround(std::cbrt(particles / 8.0))))) {}

  /// One more round.
  template <class Kernel, class Real>
  void measure(std::string_view kernel, std::string_view precision) {
    Body<Kernel, Real> body(edge_);
    add<RecomputedWeights<Kernel, Real, 3>>({kernel, precision, kAsInFirn}, body);
    add<RecomputedByNode<Kernel, Real, 3>>({kernel, precision, "recomputed by node"}, body);
    add<WeightsByAxis<Kernel, Real, 3>>({kernel, precision, "stored by axis"}, body);
    add<WeightsByNode<Kernel, Real, 3>>({kernel, precision, "stored by node"}, body);
  }

  BenchRows rows() const {
    BenchRows out;
    double as_in_firn = 0;
    for (const Measurement& m : measurements_) {
      if (m.weights == kAsInFirn) as_in_firn = m.best.step();  // the first of its kernel and precision
      nlohmann::ordered_json traffic, prepared;
      if (m.stored_bytes > 0) {
        traffic = m.traffic;
        prepared = m.best.weights;
      }
      out.push_back({{"case", "weights"},
                     {"kernel", m.kernel},
                     {"precision", m.precision},
                     {"threads", 1},
                     {"isa", "plain"},
                     {"weights", m.weights},
                     {"particles", m.particles},
                     {"stored_bytes_per_particle", m.stored_bytes},
                     {"traffic_ns", traffic},
                     {"ns_per_particle_step", m.best.step()},
                     {"median_ns", median(m.samples)},
                     {"ratio", m.best.step() / as_in_firn},
                     {"passes", {{"weights", prepared}, {"p2g", m.best.p2g}, {"g2p", m.best.g2p}}}});
    }
    return out;
  }

 private:
  template <class Weights, class Kernel, class Real>
  void add(const Measurement& wanted, Body<Kernel, Real>& body) {
    const auto same = [&](const Measurement& m) {
      return m.kernel == wanted.kernel && m.precision == wanted.precision && m.weights == wanted.weights;
    };
    auto m = std::find_if(measurements_.begin(), measurements_.end(), same);
    if (m == measurements_.end()) m = measurements_.insert(m, wanted);
    m->particles = body.size();
    m->stored_bytes = Weights::stored_bytes;
    const Round round = time_passes<Weights>(body);
    m->samples.push_back(round.step());
    if (m->samples.back() == best(m->samples)) m->best = round;
    if (m->stored_bytes > 0) m->traffic = std::min(m->traffic, time_traffic(m->particles, m->stored_bytes));
  }

  int edge_;  // cells
  std::vector<Measurement> measurements_;
};

}  // namespace

int run_bench_weights(const BenchWeightsOptions& options, std::ostream& out) {
  BenchProgress progress(options.rounds);
  WeightsBench bench(options.particles);
  for (int r = 1; r <= options.rounds; ++r) {
    progress.show(r, "quadratic float");
    bench.measure<QuadraticKernel, float>("quadratic", "float");
    progress.show(r, "quadratic double");
    bench.measure<QuadraticKernel, double>("quadratic", "double");
    progress.show(r, "linear float");
    bench.measure<LinearKernel, float>("linear", "float");
    progress.show(r, "linear double");
    bench.measure<LinearKernel, double>("linear", "double");
  }
  progress.finish();
  options.json ? print_json(bench.rows(), out) : print_csv(bench.rows(), out);
  return 0;
}

}  // namespace firn
