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

/// The effects ready for a simulation's particles.
class ParticleForces {
 public:
  /// `start`, `mass`: of every particle, by its id.
  ParticleForces(const ForceEffects& effects, std::vector<Vec3> start, std::span<const double> mass)
      : start_(std::move(start)) {
    if (effects.acceleration) acceleration_.emplace(*effects.acceleration);
    for (const Load& load : effects.loads) {
      const std::vector<bool> in = inside(*load.region, start_);
      double total = 0;
      for (std::size_t p = 0; p < start_.size(); ++p) total += in[p] ? mass[p] : 0;
      Share& share = loads_.emplace_back(Share{Formulas(load.force), std::vector<double>(start_.size())});
      for (std::size_t p = 0; p < start_.size(); ++p) share.part[p] = in[p] ? mass[p] / total : 0;
    }
  }

  /// Fills the column `force` with what acts at `time`.
  template <class Real, int D>
  void update(ParticleTable<Real, D>& particles, double time) {
    const auto position = particles.template view<Column::position>();
    const auto mass = particles.template view<Column::mass>();
    const auto force = particles.template view<Column::force>();
    const auto id = particles.id();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, particles.size(), kGrain), [&](const auto& range) {
      std::array<double, 7> at{};
      at[6] = time;
      for (std::size_t p = range.begin(); p < range.end(); ++p) {
        const auto x = position.load(p);
        for (int d = 0; d < D; ++d) at[static_cast<std::size_t>(d)] = static_cast<double>(x[d]);
        for (int d = 0; d < 3; ++d) at[static_cast<std::size_t>(3 + d)] = start_[id[p]][d];
        std::array<double, 3> f{};
        if (acceleration_) add(static_cast<double>(mass.load(p)), acceleration_->local()(at), f);
        for (Share& load : loads_)
          if (load.part[id[p]] > 0) add(load.part[id[p]], load.force.local()(at), f);
        Vector<Real, D> out;
        for (int d = 0; d < D; ++d) out[d] = static_cast<Real>(f[static_cast<std::size_t>(d)]);
        force.store(p, out);
      }
    });
  }

  std::size_t bytes() const {
    return start_.size() * sizeof(Vec3) + loads_.size() * start_.size() * sizeof(double);
  }

 private:
  static constexpr std::size_t kGrain = 1024;
  using Formulas = tbb::enumerable_thread_specific<VectorFormula>;
  struct Share {
    Formulas force;
    std::vector<double> part;  // of the whole force, by id
  };

  static void add(double factor, const std::array<double, 3>& v, std::array<double, 3>& sum) {
    for (std::size_t d = 0; d < 3; ++d) sum[d] += factor * v[d];
  }

  std::vector<Vec3> start_;  // m, by id
  std::optional<Formulas> acceleration_;
  std::vector<Share> loads_;
};

}  // namespace firn
