// The return map and the stress of every particle of a batch: the one place where the step meets a material.
#pragma once

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "engine/particles/particle_table.h"
#include "engine/passes/reports.h"
#include "materials/material_point.h"

namespace firn {

/// Particles are taken in pieces of this many, whatever the number of threads, so that sums are always added
/// alike.
inline constexpr std::size_t kGrain = 1024;

template <class Model, class Real, int D>
MaterialReport material_pass(const Model& model, ParticleTable<Real, D>& particles, Real dt) {
  using Point = typename Model::template Point<Real, D>;
  const auto volume = particles.template view<Column::volume>();
  const auto stress = particles.template view<Column::stress>();
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, particles.size(), kGrain), MaterialReport{},
      [&](const tbb::blocked_range<std::size_t>& range, MaterialReport report) {
        Real max_modulus = 0;
        for (std::size_t p = range.begin(); p < range.end(); ++p) {
          Point point;
          point.visit([&](auto column, auto& value) { value = particles.template view<column()>().load(p); });
          const Response<Real, D> response = model.update(point, dt);
          point.visit(
              [&](auto column, const auto& value) { particles.template view<column()>().store(p, value); });
          stress.store(p, response.tau);
          max_modulus = std::max(max_modulus, response.wave_modulus);
          report.dissipated += static_cast<double>(response.dissipated) * static_cast<double>(volume.load(p));
          report.capped += response.capped > Real(0) ? 1 : 0;
          report.invalid += std::isfinite(response.wave_modulus + frobenius2(response.tau)) ? 0 : 1;
        }
        report.max_wave_modulus = std::max(report.max_wave_modulus, static_cast<double>(max_modulus));
        return report;
      },
      [](MaterialReport a, const MaterialReport& b) {
        a.join(b);
        return a;
      });
}

}  // namespace firn
