// Multiplicative plasticity F = F_E F_P whose yield surface is given in stresses: an energy, and a flow that
// says where in its principal stretches a trial state comes to rest. A flow is composed of a yield surface,
// what hardens it and how its rate counts (materials/yields, hardening, rates):
//
//   using History                                                 // what it remembers of a point
//   History<double> initial() const
//   Vector<L, D> project(Vector<L, D> s, moduli, History<L>&, L dt) const
//   std::string branch(...) const                                 // the same case in words, for readers
//
// `s` comes in positive and goes out positive; an elastic state comes out with the same bits.
//
// Stretches: a trial state may be inverted or flat. A law in the logarithms of s, or in F F^T, takes it for
// its mirror image; one too flat for a matrix of the number type to hold, so that its determinant has a sign,
// is taken for as flat as one can be. Both are counted in `capped`, and det F_E > 0 afterwards.
//
// F_P: what flows for long stretches without bound, and no stress here depends on F_P. Before its determinant
// could overflow it stands still, which is counted too.
#pragma once

#include "engine/math/svd.h"
#include "materials/material_point.h"
#include "materials/principal.h"

namespace firn {

template <class F, class E>
concept FlowFor = F::template valid_with<E>&& requires(const F& f, const Vector<double, 3>& s,
                                                       typename F::template History<double>& h) {
  { F::name } -> std::convertible_to<std::string_view>;
  { F::hardening_name } -> std::convertible_to<std::string_view>;
  { f.project(s, Lame<double>{}, h, 1.0) } -> std::same_as<Vector<double, 3>>;
  { f.branch(s, Lame<double>{}, h, 1.0) } -> std::same_as<std::string>;
  { f.initial() } -> std::same_as<typename F::template History<double>>;
};

/// The stretches a law in |s| sees, and whether they are not those of F_E.
template <class L, int D>
struct Stretches {
  Vector<L, D> s;
  LaneMask<L> mended;

  explicit Stretches(const Vector<L, D>& signed_s) : s(signed_s) {
    const double flat = 64 * static_cast<double>(std::numeric_limits<LaneReal<L>>::epsilon());
    L longest = abs(signed_s[0]);
    for (int k = 1; k < D; ++k) longest = max(abs(signed_s[k]), longest);
    longest = max(longest, L(sizeof(LaneReal<L>) == 4 ? 1e-8 : 1e-80));
    L volume = L(1);  // beside that of a cube of the longest
    for (int k = 0; k < D; ++k) {
      s[k] = max(L(flat) * longest, abs(signed_s[k]));  // a NaN stays one
      volume = volume * (s[k] / longest);
    }
    // Two short ones: their product is what the round-off of the long one stands beside.
    if constexpr (D == 3)
      for (int k = 0; k < D; ++k)
        s[k] = select(volume < L(flat), max(s[k], L(std::sqrt(flat)) * longest), s[k]);
    mended = differs(s, signed_s);
  }
};

/// Moves the point from stretches f.s to `s`, F_E F_P unchanged: F_E += U (s - f.s) V^T, F_P += V (f.s/s - 1)
/// V^T F_P. By increments, so that round-off does not drift; but where a stretch shrinks a lot the difference
/// would keep the round-off of the long one, and F_E is built anew. Returns where F_P can grow no more.
template <class L, int D, template <class> class History>
LaneMask<L> move_to(PlasticPoint<L, D, History>& p, const Svd<L, D>& f, const Vector<L, D>& s) {
  Vector<L, D> plastic;
  LaneMask<L> far = s[0] < L(0);
  for (int k = 0; k < D; ++k) {
    plastic[k] = (f.s[k] - s[k]) / s[k];
    far = far | (abs(f.s[k] - s[k]) > L(0.5) * s[k]);
  }
  const Matrix<L, D> trial = p.F_E;
  p.F_E = trial + compose(f.U, s - f.s, f.V);
  if (any(far)) p.F_E = chosen(far, compose(f.U, s, f.V), p.F_E);
  const Matrix<L, D> F_P = p.F_P + compose(f.V, plastic, f.V) * p.F_P;
  const LaneMask<L> full = !(frobenius2(F_P) < L(sizeof(LaneReal<L>) == 4 ? 1e22 : 1e200));
  p.F_P = any(full) ? chosen(full, p.F_P, F_P) : F_P;
  return full;
}

template <class EnergyPart, class FlowPart>
requires PrincipalEnergy<EnergyPart> && FlowFor<FlowPart, EnergyPart>
struct FlowPlastic {
  using Energy = EnergyPart;
  using Flow = FlowPart;
  template <class L, int D>
  using Point = PlasticPoint<L, D, Flow::template History>;
  static constexpr std::string_view yield_name = Flow::name, hardening_name = Flow::hardening_name;
  static constexpr std::string_view decomposition = "SVD";

  double density;       // kg/m^3 at rest
  Lame<double> moduli;  // Pa
  Flow flow;

  template <class L, int D>
  Point<L, D> at_rest() const {
    return {Matrix<L, D>::identity(), Matrix<L, D>::identity(), flow.initial().template as<L>()};
  }

  template <class L, int D>
  Response<L, D> update(PlasticPoint<L, D, Flow::template History>& p, L dt) const {
    const Lame<L> m = moduli.as<L>();
    const Svd<L, D> f = svd_any_order(p.F_E);
    const Stretches<L, D> trial(f.s);
    // Without time nothing flows, and what hardened is not asked again.
    const Vector<L, D> s = any(dt > L(0)) ? flow.project(trial.s, m, p.history, dt) : trial.s;
    Response<L, D> out;
    out.dissipated = L(0);
    LaneMask<L> capped = trial.mended;
    // Most steps of most points are elastic; what follows would change no bit of them.
    if (any(differs(s, f.s))) {
      capped = capped | move_to(p, f, s);
      out.dissipated = select(differs(s, trial.s), Energy::density(trial.s, m) - Energy::density(s, m), L(0));
    }
    out.tau = compose(f.U, Energy::kirchhoff(s, m), f.U);
    out.wave_modulus = Energy::wave_modulus(s, m);
    out.capped = select(capped, L(1), L(0));
    return out;
  }

  template <class L, int D>
  L energy(const PlasticPoint<L, D, Flow::template History>& p) const {
    return Energy::density(Stretches<L, D>(svd_any_order(p.F_E).s).s, moduli.as<L>());
  }

  /// The moduli this point has now.
  template <class L, int D>
  Lame<L> current_moduli(const PlasticPoint<L, D, Flow::template History>&) const {
    return moduli.as<L>();
  }
};

}  // namespace firn
