// Forces on particles from outside, which P2G hands to the grid as it does internal ones:
//   f_i = sum_p S_ip f_p                    (Buzzi, Pedroso & Giacomini 2008, eq. 13: part of f^e)
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "engine/base/vector_formula.h"
#include "engine/particles/particle_table.h"
#include "engine/shapes/shape.h"

namespace firn {

/// A force that the particles which start in a region share by their mass.
struct Load {
  std::string name;
  ShapePtr region;
  VectorFormula force;  // N, of x, y, z, X, Y, Z, t
};

/// What a scene names of them.
struct ForceEffects {
  std::optional<VectorFormula> acceleration;  // m/s^2, of x, y, z, X, Y, Z, t
  std::vector<Load> loads;

  bool any() const { return acceleration || !loads.empty(); }
};

/// Which of the points lie in it.
inline std::vector<bool> inside(const Shape& region, std::span<const Vec3> points) {
  std::vector<double> phi(points.size());
  region.distance(points, phi);
  std::vector<bool> out(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) out[p] = phi[p] < 0;
  return out;
}

/// The effects ready for a simulation's particles. Each is a formula times a weight of the particle: for an
/// acceleration its mass, for a load its share.
class ParticleForces {
 public:
  /// `start` (m), `mass` (kg): of every particle, by its id.
  ParticleForces(const ForceEffects& effects, std::vector<Vec3> start, const std::vector<double>& mass)
      : start_(std::move(start)) {
    if (effects.acceleration) terms_.push_back({Formulas(*effects.acceleration), mass});
    for (const Load& load : effects.loads)
      terms_.push_back({Formulas(load.force), shares(*load.region, mass)});
  }

  /// Fills the column `force` with what acts at `time`, s.
  template <class Real, int D>
  void update(ParticleTable<Real, D>& particles, double time) {
    const auto force = particles.template view<Column::force>();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles.size(), kGrain), [&](const auto& range) {
      for (std::size_t p = range.begin(); p < range.end(); ++p) force.store(p, Vector<Real, D>::zero());
      for (Term& term : terms_) add(term.formula.local(), term.weight, time, range, particles);
    });
  }

  std::size_t bytes() const { return start_.size() * (sizeof(Vec3) + terms_.size() * sizeof(double)); }

 private:
  static constexpr std::size_t kGrain = 1024;
  using Formulas = tbb::enumerable_thread_specific<VectorFormula>;
  struct Term {
    Formulas formula;
    std::vector<double> weight;  // by id
  };

  std::vector<double> shares(const Shape& region, const std::vector<double>& mass) const {
    const std::vector<bool> in = inside(region, start_);
    double total = 0;
    for (std::size_t p = 0; p < mass.size(); ++p) total += in[p] ? mass[p] : 0;
    std::vector<double> out(mass.size());
    for (std::size_t p = 0; p < mass.size(); ++p) out[p] = in[p] ? mass[p] / total : 0;
    return out;
  }

  template <class Real, int D>
  void add(const VectorFormula& formula, const std::vector<double>& weight, double time,
           const tbb::blocked_range<std::size_t>& range, ParticleTable<Real, D>& particles) const {
    const auto position = particles.template view<Column::position>();
    const auto force = particles.template view<Column::force>();
    const auto id = particles.id();
    std::array<double, 7> at{};
    at[6] = time;
    for (std::size_t p = range.begin(); p < range.end(); ++p) {
      const double w = weight[id[p]];
      if (w == 0) continue;  // outside the region
      const Vector<Real, D> x = position.load(p);
      for (int d = 0; d < D; ++d) at[static_cast<std::size_t>(d)] = static_cast<double>(x[d]);
      for (int d = 0; d < 3; ++d) at[static_cast<std::size_t>(3 + d)] = start_[id[p]][d];
      const std::array<double, 3> value = formula(at);
      Vector<Real, D> f = force.load(p);
      for (int d = 0; d < D; ++d) f[d] += static_cast<Real>(w * value[static_cast<std::size_t>(d)]);
      force.store(p, f);
    }
  }

  std::vector<Vec3> start_;  // m, by id
  std::vector<Term> terms_;
};

}  // namespace firn
