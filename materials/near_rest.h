// The response of a point near rest, up to a rotation, without a decomposition of F_E. Most points of most
// scenes are there, and the decomposition is what an update costs; points that are not go the general way.
#pragma once

#include "engine/math/near_rotation.h"
#include "materials/material_point.h"
#include "materials/principal.h"

namespace firn {

template <class Energy, class L, int D>
inline constexpr bool kHasNearRest = D == 3 && RotationEnergy<Energy>;

template <class Energy, class L>
Response<L, 3> response_near_rest(const Matrix<L, 3>& F, const NearRotation<L>& near, const Lame<L>& m) {
  return {Energy::kirchhoff(F, near.rotation(F), near.J, m),
          Energy::wave_modulus(near.largest_square, near.J, m), L(0), L(0)};
}

template <class L, int D>
Response<L, D> chosen(const LaneMask<L>& mask, const Response<L, D>& a, const Response<L, D>& b) {
  return {chosen(mask, a.tau, b.tau), select(mask, a.wave_modulus, b.wave_modulus),
          select(mask, a.dissipated, b.dissipated), select(mask, a.capped, b.capped)};
}

}  // namespace firn
