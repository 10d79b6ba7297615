// How the yield stress sigma_y (Pa, uniaxial) grows with the equivalent plastic strain alpha >= 0: isotropic
// hardening. H < 0 softens.
#pragma once

#include <string_view>

#include "engine/math/lane.h"

namespace firn {

/// sigma_y + H alpha; with H = 0 perfect plasticity.
struct LinearHardening {
  static constexpr std::string_view name = "linear";
  static constexpr bool linear = true;
  double sigma_y, H;  // Pa

  template <class L>
  L stress(const L& alpha) const {
    return L(sigma_y) + L(H) * alpha;
  }
  template <class L>
  L slope(const L&) const {
    return L(H);
  }
};

/// Voce 1948 with a linear part: sigma_y + H alpha + Q (1 - exp(-b alpha)), which saturates with strains of
/// 1/b.
struct VoceHardening {
  static constexpr std::string_view name = "Voce";
  static constexpr bool linear = false;
  double sigma_y, H, saturation, exponent;  // Pa, Pa, Q in Pa, b

  template <class L>
  L stress(const L& alpha) const {
    return L(sigma_y) + L(H) * alpha + L(saturation) * (L(1) - exp(-(L(exponent) * alpha)));
  }
  template <class L>
  L slope(const L& alpha) const {
    return L(H) + L(saturation * exponent) * exp(-(L(exponent) * alpha));
  }
};

/// Ludwik's power A + B alpha^n, the strain part of Johnson & Cook 1983. Its slope at alpha = 0 is infinite
/// for n < 1; below kLeastStrain the power is a straight line.
struct PowerHardening {
  static constexpr std::string_view name = "power";
  static constexpr bool linear = false;
  static constexpr double kLeastStrain = 1e-9;
  double A, B, n;  // Pa, Pa, -

  template <class L>
  L stress(const L& alpha) const {
    const L from = max(alpha, L(kLeastStrain));
    return L(A) + L(B) * exp(L(n) * log(from)) * (alpha / from);
  }
  template <class L>
  L slope(const L& alpha) const {
    const L from = max(alpha, L(kLeastStrain));
    return L(B) * select(alpha > L(kLeastStrain), L(n), L(1)) * exp(L(n - 1) * log(from));
  }
};

}  // namespace firn
