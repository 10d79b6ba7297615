// What a material model sees of a particle and what it answers. A model is a const struct of parameters with
//
//   static constexpr std::string_view name;
//   double density;                                              // kg/m^3 at rest
//   template <class L, int D> using Point = ElasticPoint<L, D>;  // or PlasticPoint, or its own state
//   template <class L, int D> Point<L, D> at_rest() const;
//   template <class L, int D> Response<L, D> update(Point<L, D>& p, L dt) const;
//   template <class L, int D> L energy(const Point<L, D>& p) const;  // J per m^3 at rest
//
// `update` is given the trial F_E of the step just taken. It projects the point onto what the model allows
// (F_E F_P unchanged) and answers with the stress of the projected state: one decomposition of F_E serves
// both. With dt = 0 it is asked for the stress of a state it has answered before (or, at t = 0, of the seeded
// one), which nothing may flow away from any more. Pure functions over a lane type
// (engine/math/lane.h): no branches on data.
#pragma once

#include <type_traits>

#include "engine/math/matrix.h"
#include "engine/particles/columns.h"

namespace firn {

template <Column c>
using ColumnTag = std::integral_constant<Column, c>;

template <class L, int D>
struct ElasticPoint {
  Matrix<L, D> F_E;

  static constexpr ColumnSet columns{Column::elastic_deformation};
  /// Calls f(ColumnTag<c>{}, value) for every column of the point: how passes load and store it.
  template <class F>
  void visit(F&& f) {
    f(ColumnTag<Column::elastic_deformation>{}, F_E);
  }
};

/// What a point remembers beside its deformation.
template <class L>
struct NoHistory {
  static constexpr ColumnSet columns{};
  template <class F>
  void visit(F&&) {}
  template <class M>
  NoHistory<M> as() const {
    return {};
  }
};
template <class L>
struct HardeningHistory {
  L alpha;

  static constexpr ColumnSet columns{Column::hardening};
  template <class F>
  void visit(F&& f) {
    f(ColumnTag<Column::hardening>{}, alpha);
  }
  template <class M>
  HardeningHistory<M> as() const {
    return {M(alpha)};
  }
};
template <class L>
struct GranularHistory {
  L alpha;        // Klar's q
  L volume_gain;  // v_c

  static constexpr ColumnSet columns{Column::hardening, Column::volume_gain};
  template <class F>
  void visit(F&& f) {
    f(ColumnTag<Column::hardening>{}, alpha);
    f(ColumnTag<Column::volume_gain>{}, volume_gain);
  }
  template <class M>
  GranularHistory<M> as() const {
    return {M(alpha), M(volume_gain)};
  }
};

template <class L, int D, template <class> class HistoryOf = NoHistory>
struct PlasticPoint {
  using History = HistoryOf<L>;
  Matrix<L, D> F_E, F_P;
  [[no_unique_address]] History history{};

  static constexpr ColumnSet columns =
      ColumnSet{Column::elastic_deformation, Column::plastic_deformation} | History::columns;
  template <class F>
  void visit(F&& f) {
    f(ColumnTag<Column::elastic_deformation>{}, F_E);
    f(ColumnTag<Column::plastic_deformation>{}, F_P);
    history.visit(f);
  }
};

template <class L, int D>
struct Response {
  Matrix<L, D> tau;  // Kirchhoff stress, Pa, symmetric; positive in tension
  L wave_modulus;    // Pa: (rest density) x (fastest wave speed)^2 in the deformed, hardened state
  L dissipated;      // J per m^3 at rest that this return map took out of the stored energy
  L capped;          // 1 where a cap of the model was active (counted, never silent), else 0
};

}  // namespace firn
