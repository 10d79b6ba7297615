// The conserved quantities and energies of a batch, in double, added in a fixed order.
#pragma once

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "engine/particles/frame_view.h"
#include "engine/passes/material_pass.h"

namespace firn {

inline void join(FrameTotals& a, const FrameTotals& b) {
  a.mass += b.mass;
  for (int d = 0; d < 3; ++d) {
    a.momentum[d] += b.momentum[d];
    a.angular[d] += b.angular[d];
  }
  a.kinetic += b.kinetic;
  a.elastic += b.elastic;
  a.gravity += b.gravity;
  a.dissipated += b.dissipated;
  a.max_speed = std::max(a.max_speed, b.max_speed);
  a.min_J = std::min(a.min_J, b.min_J);
  a.max_J = std::max(a.max_J, b.max_J);
}

namespace detail {

template <int D, class Real>
Vector<double, 3> widened(const Vector<Real, D>& v) {
  auto out = Vector<double, 3>::zero();
  for (int d = 0; d < D; ++d) out[d] = static_cast<double>(v[d]);
  return out;
}

}  // namespace detail

/// `inverse_inertia`: h^2 D_p^-1 of the kernel. The affine part of APIC counts: 1/2 m tr(C D C^T) and m D
/// (C^T - C).
template <class Model, class Real, int D>
FrameTotals totals(const Model& model, const ParticleTable<Real, D>& particles, double h,
                   double inverse_inertia, const Vector<double, 3>& gravity) {
  const auto position = particles.template view<Column::position>();
  const auto velocity = particles.template view<Column::velocity>();
  const auto mass = particles.template view<Column::mass>();
  const auto volume = particles.template view<Column::volume>();
  const double inertia = h * h / inverse_inertia;  // D_p is this times the identity
  FrameTotals none;
  none.min_J = std::numeric_limits<double>::infinity();
  none.max_J = -none.min_J;
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, particles.size(), kGrain), none,
      [&](const tbb::blocked_range<std::size_t>& range, FrameTotals sum) {
        for (std::size_t p = range.begin(); p < range.end(); ++p) {
          const double m = static_cast<double>(mass.load(p));
          const Vector<double, 3> x = detail::widened<D>(position.load(p)),
                                  v = detail::widened<D>(velocity.load(p));
          Vector<double, 3> angular = cross(x, v);
          double speed2 = dot(v, v);
          sum.max_speed = std::max(sum.max_speed, std::sqrt(speed2));
          if (particles.columns().has(Column::affine)) {
            const Matrix<Real, D> C = particles.template view<Column::affine>().load(p);
            speed2 += inertia * static_cast<double>(frobenius2(C));
            const auto spin = [&](int i, int j) {
              return i < D && j < D ? inertia * (static_cast<double>(C(j, i)) - static_cast<double>(C(i, j)))
                                    : 0.0;
            };
            angular += Vector<double, 3>{spin(1, 2), spin(2, 0), spin(0, 1)};
          }
          typename Model::template Point<Real, D> point;
          double J = 1;
          point.visit([&](auto column, auto& value) {
            value = particles.template view<column()>().load(p);
            if constexpr (info(column()).rank == Rank::matrix) J *= static_cast<double>(determinant(value));
          });
          sum.mass += m;
          for (int d = 0; d < 3; ++d) {
            sum.momentum[d] += m * v[d];
            sum.angular[d] += m * angular[d];
          }
          sum.kinetic += 0.5 * m * speed2;
          sum.elastic += static_cast<double>(model.energy(point)) * static_cast<double>(volume.load(p));
          sum.gravity -= m * dot(gravity, x);
          sum.min_J = std::min(sum.min_J, J);
          sum.max_J = std::max(sum.max_J, J);
        }
        return sum;
      },
      [](FrameTotals a, const FrameTotals& b) {
        join(a, b);
        return a;
      });
}

}  // namespace firn
