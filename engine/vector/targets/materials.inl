#include <utility>

#include "engine/vector/material_kernel.h"
#include "engine/vector/targets/tables.h"
#include "materials/registry.h"

namespace firn::FIRN_ISA {
namespace {

template <class Real, int D, std::size_t... I>
const MaterialKernel<Real>* kernels_of(std::index_sequence<I...>) {
  static constexpr MaterialKernel<Real> kernels[] = {
      update_tile<std::variant_alternative_t<I, Material>, Real, D>...};
  return kernels;
}

}  // namespace

template <>
const MaterialKernel<FIRN_REAL>* material_kernels<FIRN_REAL, FIRN_DIMENSION>() {
  return kernels_of<FIRN_REAL, FIRN_DIMENSION>(std::make_index_sequence<std::variant_size_v<Material>>());
}

}  // namespace firn::FIRN_ISA
