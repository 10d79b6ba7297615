// What the parts of a material promise each other, as concepts: a pair that does not fit does not compile.
//
// An energy is isotropic: a function of the signed singular values s of F, in any order, and the moduli.
// Its Kirchhoff stress has F's left singular vectors as axes, tau_k = s_k dpsi/ds_k, positive in tension.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

#include "engine/math/matrix.h"
#include "materials/elastic_moduli.h"

namespace firn {

/// The first and second derivatives of psi in s, for the tangent of P = U diag(p) V^T. Cold code, double
/// only.
template <int D>
struct PrincipalDerivatives {
  Vector<double, D> p;      // dpsi/ds_i, Pa
  Matrix<double, D> H;      // d2psi/(ds_i ds_j), Pa
  Matrix<double, D> minus;  // (p_i - p_j) / (s_i - s_j), its limit where s_i = s_j; i != j
  Matrix<double, D> plus;   // (p_i + p_j) / (s_i + s_j); i != j
};

/// `x`, moved away from zero to at least `least` in magnitude: where an energy is not differentiable, its
/// derivatives come out large instead of infinite.
template <class L>
L away_from_zero(L x, L least) {
  return copysign(max(abs(x), least), x);
}

template <class L, int D>
L product(const Vector<L, D>& s) {
  L out = s[0];
  for (int k = 1; k < D; ++k) out = out * s[k];
  return out;
}
template <class L, int D>
L sum(const Vector<L, D>& s) {
  L out = s[0];
  for (int k = 1; k < D; ++k) out = out + s[k];
  return out;
}
/// x - mean(x).
template <class L, int D>
Vector<L, D> deviator(const Vector<L, D>& x) {
  const L mean = L(1.0 / D) * sum(x);
  Vector<L, D> out;
  for (int k = 0; k < D; ++k) out[k] = x[k] - mean;
  return out;
}
/// The largest square, and the least value.
template <class L, int D>
L largest_square(const Vector<L, D>& s) {
  L out = s[0] * s[0];
  for (int k = 1; k < D; ++k) out = max(s[k] * s[k], out);
  return out;
}
template <class L, int D>
L least(const Vector<L, D>& s) {
  L out = s[0];
  for (int k = 1; k < D; ++k) out = min(s[k], out);
  return out;
}
/// Where a and b are not the same; NaN differs from everything.
template <class L, int D>
LaneMask<L> differs(const Vector<L, D>& a, const Vector<L, D>& b) {
  LaneMask<L> out = !(a[0] == b[0]);
  for (int k = 1; k < D; ++k) out = out | !(a[k] == b[k]);
  return out;
}
/// dJ/ds_i and, for i != j, d2J/(ds_i ds_j): the product of the other singular values.
template <class L, int D>
L product_without(const Vector<L, D>& s, int i, int j = -1) {
  L out = L(1);
  for (int k = 0; k < D; ++k)
    if (k != i && k != j) out = out * s[k];
  return out;
}

template <class E>
concept PrincipalEnergy = requires(const Vector<double, 3>& s, const Lame<double>& m) {
  { E::name } -> std::convertible_to<std::string_view>;
  { E::density(s, m) } -> std::same_as<double>;               // psi, J per m^3 at rest
  { E::kirchhoff(s, m) } -> std::same_as<Vector<double, 3>>;  // tau_k, Pa
  { E::wave_modulus(s, m) } -> std::same_as<double>;          // Pa, see Response
  { E::capped(s) } -> std::same_as<double>;  // 1 where a floor of the energy is active, else 0
  { E::derivatives(s, m) } -> std::same_as<PrincipalDerivatives<3>>;
};

/// An energy that needs no decomposition of F.
template <class E>
concept DirectEnergy = PrincipalEnergy<E> && requires(const Matrix<double, 3>& F, const Lame<double>& m) {
  { E::direct_density(F, m) } -> std::same_as<double>;
  {E::direct_response(F, m)};
};

/// An energy whose stress also follows from F and the rotation of its polar decomposition.
template <class E>
concept RotationEnergy = PrincipalEnergy<E> &&
    requires(const Matrix<double, 3>& F, double J, const Lame<double>& m) {
  { E::kirchhoff(F, F, J, m) } -> std::same_as<Matrix<double, 3>>;
  { E::wave_modulus(J, J, m) } -> std::same_as<double>;  // from a bound on s_k^2, and J
};

/// A yield set in the singular values; it names the energies it is valid with.
template <class Y, class E>
concept YieldFor = Y::template valid_with<E>&& requires(const Y& y, const Vector<double, 3>& s) {
  { Y::name } -> std::convertible_to<std::string_view>;
  { y.project(s) } -> std::same_as<Vector<double, 3>>;
  { y.branch(s) } -> std::same_as<std::string>;
};

/// A factor on the moduli from the plastic volume ratio J_P = det F_P.
template <class H>
concept Hardening = requires(const H& h, double J_P) {
  { H::name } -> std::convertible_to<std::string_view>;
  { h.evaluate(J_P).factor } -> std::convertible_to<double>;
  { h.evaluate(J_P).capped } -> std::convertible_to<double>;
};

}  // namespace firn
