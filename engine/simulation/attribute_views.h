// The attributes a cache asks for, computed from the columns as they are copied out.
#pragma once

#include <cmath>
#include <numbers>

#include "engine/particles/frame_view.h"
#include "engine/passes/batch.h"
#include "engine/scene/attributes.h"

namespace firn {
namespace detail {

/// Calls f(batch index, particle in it, place in the output) for particles [first, first + count) of all
/// batches.
template <class Real, int D, class F>
void for_particles(std::span<const Batch<Real, D>> batches, std::size_t first, std::size_t count, F&& f) {
  std::size_t begin = 0, out = 0;
  for (std::size_t b = 0; b < batches.size() && out < count; ++b) {
    const std::size_t size = batches[b].particles.size();
    for (std::size_t p = first + out - begin; p < size && out < count; ++p) f(b, p, out++);
    begin += size;
  }
}

template <class Real, int D>
double det_F(const ParticleTable<Real, D>& particles, std::size_t p) {
  double J = static_cast<double>(determinant(particles.template view<Column::elastic_deformation>().load(p)));
  if (particles.columns().has(Column::plastic_deformation))
    J *= static_cast<double>(determinant(particles.template view<Column::plastic_deformation>().load(p)));
  return J;
}

template <int D, class Real>
void put_vector(const Vector<Real, D>& v, float* out) {
  for (int d = 0; d < 3; ++d) out[d] = d < D ? static_cast<float>(v[d]) : 0.0F;
}

/// `fill`: what stands on the diagonal of the axes that the scene does not have.
template <int D, class Real>
void put_matrix(const Matrix<Real, D>& m, float fill, float* out) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[3 * i + j] = i < D && j < D ? static_cast<float>(m(i, j)) : (i == j ? fill : 0.0F);
}

/// The radius of a ball of the particle's rest volume (a disk's, half a rod's length), which is what pscale
/// means.
template <int D>
double ball_radius(double volume) {
  if constexpr (D == 1) return volume / 2;
  if constexpr (D == 2) return std::sqrt(volume / std::numbers::pi);
  return std::cbrt(volume * 3 / (4 * std::numbers::pi));
}

/// Writes one attribute of one particle. Parameters: table, particle, batch index, out.
template <class Real, int D>
using Writer = void (*)(const ParticleTable<Real, D>&, std::size_t, std::size_t, float*);

template <class Real, int D>
Writer<Real, D> writer(std::string_view name) {
  using Table = ParticleTable<Real, D>;
  if (name == "P")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      put_vector<D>(t.template view<Column::position>().load(p), out);
    };
  if (name == "v")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      put_vector<D>(t.template view<Column::velocity>().load(p), out);
    };
  if (name == "pscale")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out =
          static_cast<float>(ball_radius<D>(static_cast<double>(t.template view<Column::volume>().load(p))));
    };
  if (name == "F_E")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      put_matrix<D>(t.template view<Column::elastic_deformation>().load(p), 1.0F, out);
    };
  if (name == "F_P")  // an elastic body in a scene with plastic ones has F_P = I
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      put_matrix<D>(t.columns().has(Column::plastic_deformation)
                        ? t.template view<Column::plastic_deformation>().load(p)
                        : Matrix<Real, D>::identity(),
                    1.0F, out);
    };
  if (name == "Jp")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out = t.columns().has(Column::plastic_deformation)
                 ? static_cast<float>(determinant(t.template view<Column::plastic_deformation>().load(p)))
                 : 1.0F;
    };
  if (name == "alpha")  // a body that does not harden, in a scene with one that does, has none
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out = t.columns().has(Column::hardening)
                 ? static_cast<float>(t.template view<Column::hardening>().load(p))
                 : 0.0F;
    };
  if (name == "C")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      put_matrix<D>(t.template view<Column::affine>().load(p), 0.0F, out);
    };
  if (name == "stress")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      put_matrix<D>(static_cast<Real>(1 / det_F(t, p)) * t.template view<Column::stress>().load(p), 0.0F,
                    out);
    };
  if (name == "pressure")  // of D axes: the third of a plane scene carries no stress that it knows of
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out = static_cast<float>(-static_cast<double>(trace(t.template view<Column::stress>().load(p))) /
                                (D * det_F(t, p)));
    };
  if (name == "density")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out =
          static_cast<float>(static_cast<double>(t.template view<Column::mass>().load(p)) /
                             (static_cast<double>(t.template view<Column::volume>().load(p)) * det_F(t, p)));
    };
  if (name == "mass")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out = static_cast<float>(t.template view<Column::mass>().load(p));
    };
  if (name == "volume")
    return [](const Table& t, std::size_t p, std::size_t, float* out) {
      *out = static_cast<float>(static_cast<double>(t.template view<Column::volume>().load(p)) * det_F(t, p));
    };
  if (name == "material")
    return [](const Table&, std::size_t, std::size_t batch, float* out) { *out = static_cast<float>(batch); };
  return nullptr;
}

}  // namespace detail

/// The view of one attribute over all batches, which must outlive it.
template <class Real, int D>
AttributeView attribute_view(std::span<const Batch<Real, D>> batches, std::string_view name, int components) {
  const auto write = detail::writer<Real, D>(name);
  FIRN_CHECK(write != nullptr);
  return {std::string(name), components, [=](std::size_t first, std::span<float> out) {
            const std::size_t count = out.size() / static_cast<std::size_t>(components);
            detail::for_particles<Real, D>(
                batches, first, count, [&](std::size_t b, std::size_t p, std::size_t k) {
                  write(batches[b].particles, p, b, out.data() + k * static_cast<std::size_t>(components));
                });
          }};
}

}  // namespace firn
