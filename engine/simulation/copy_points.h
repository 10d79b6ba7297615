// Particles with the stress of their state, for comparisons.
#pragma once

#include <tbb/parallel_for.h>

#include "engine/particles/particle_table.h"
#include "engine/simulation/simulation.h"

namespace firn {

template <int D, class Model, class Real>
void copy_points(const Model& model, const ParticleTable<Real, D>& particles, MaterialPoints& out) {
  tbb::parallel_for(std::size_t{0}, particles.size(), [&](std::size_t p) {
    const std::size_t id = particles.id()[p];
    typename Model::template Point<double, D> point;
    double J = 1;
    point.visit([&](auto column, auto& value) {
      const auto stored = particles.template view<column()>().load(p);
      if constexpr (info(column()).rank == Rank::matrix) {
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j) value(i, j) = static_cast<double>(stored(i, j));
        J *= determinant(value);
      } else {
        value = static_cast<double>(stored);
      }
    });
    // The state is behind its return map, which in no time changes nothing more.
    const Matrix<double, D> tau = model.update(point, 0.0).tau;
    const auto x = particles.template view<Column::position>().load(p);
    const auto v = particles.template view<Column::velocity>().load(p);
    out.mass[id] = static_cast<double>(particles.template view<Column::mass>().load(p));
    for (int i = 0; i < D; ++i) {
      out.position[id][i] = static_cast<double>(x[i]);
      out.velocity[id][i] = static_cast<double>(v[i]);
      for (int j = 0; j < D; ++j) out.stress[id](i, j) = tau(i, j) / J;
    }
  });
}

}  // namespace firn
