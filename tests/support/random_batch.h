// Particles in a random but repeatable state.
#pragma once

#include <random>

#include "engine/passes/batch.h"
#include "engine/passes/transfer.h"

namespace firn::test {

/// `count` particles in a cube of `edge` cells about the origin, so that negative coordinates take part; F
/// near the identity, everything else of size one.
template <class Real, int D>
Batch<Real, D> random_batch(std::size_t count, double h, double edge, ColumnSet columns, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Batch<Real, D> batch{ParticleTable<Real, D>(columns, count), {}};
  auto& t = batch.particles;
  const auto vector = [&](double scale) {
    Vector<Real, D> out;
    for (int d = 0; d < D; ++d) out[d] = static_cast<Real>(scale * unit(random));
    return out;
  };
  const auto matrix = [&](double scale) {
    Matrix<Real, D> out;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) out(i, j) = static_cast<Real>(scale * unit(random));
    return out;
  };
  for (std::size_t p = 0; p < count; ++p) {
    t.id()[p] = static_cast<std::uint32_t>(p);
    t.template view<Column::position>().store(p, vector(edge * h / 2));
    t.template view<Column::velocity>().store(p, vector(1));
    t.template view<Column::mass>().store(p, static_cast<Real>(1 + 0.5 * unit(random)));
    t.template view<Column::volume>().store(p, static_cast<Real>(1 + 0.5 * unit(random)));
    const Matrix<Real, D> a = matrix(1);
    t.template view<Column::stress>().store(p, a + transpose(a));
    t.template view<Column::elastic_deformation>().store(p, Matrix<Real, D>::identity() + matrix(0.1));
    if (columns.has(Column::affine)) t.template view<Column::affine>().store(p, matrix(1));
    if (columns.has(Column::plastic_deformation))
      t.template view<Column::plastic_deformation>().store(p, Matrix<Real, D>::identity() + matrix(0.1));
  }
  return batch;
}

}  // namespace firn::test
