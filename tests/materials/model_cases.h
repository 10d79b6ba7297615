// Every model of the registry in every dimension and number type: what the contract tests run over.
#pragma once

#include <tuple>

#include "materials/registry.h"
#include "materials/tangent.h"
#include "tests/engine/math/matrix_classes.h"

namespace firn::test {

template <class M, int Dimension, class Number>
struct Case {
  using Model = M;
  using Real = Number;
  static constexpr int D = Dimension;
  using Point = typename M::template Point<Number, Dimension>;
  static constexpr bool plastic = Point::columns.has(Column::plastic_deformation);
  static constexpr bool fluid = std::is_same_v<M, Fluid>;  // forgets its shape in every step
  static constexpr bool grains = Point::columns.has(Column::volume_gain);
  static constexpr bool isochoric = !std::is_same_v<M, RankineCutOff> && !grains && [] {
    if constexpr (requires { typename M::Flow; }) return !std::is_same_v<typename M::Flow, CohesiveCamClay>;
    return false;
  }();
  static constexpr bool lagged = grains || std::is_same_v<M, NaccWolper2019>;
  static constexpr bool viscous = [] {
    if constexpr (requires { M::Flow::rate_name; }) return M::Flow::rate_name != "none";
    return false;
  }();
};

template <class... Models>
std::tuple<Case<Models, 1, double>..., Case<Models, 2, double>..., Case<Models, 3, double>...>
    double_cases_of(std::type_identity<std::variant<Models...>>);
template <class... Models>
std::tuple<Case<Models, 1, float>..., Case<Models, 2, float>..., Case<Models, 3, float>...> float_cases_of(
    std::type_identity<std::variant<Models...>>);

using DoubleCases = decltype(double_cases_of(std::type_identity<Material>{}));
using FloatCases = decltype(float_cases_of(std::type_identity<Material>{}));
using AllCases = decltype(std::tuple_cat(DoubleCases{}, FloatCases{}));

/// The model's defaults; where it has none, or ones that a soft solid never reaches, a soft solid's that
/// yields at a strain of a percent or two.
template <class Model>
Model sample_model() {
  ParameterValues values = {{"density", 1000},
                            {"youngs_modulus", 1.4e5},
                            {"poissons_ratio", 0.2},
                            {"sigma_y", 3000},
                            {"saturation", 1000},
                            {"exponent", 20},
                            {"eta", 10},
                            {"A", 3000},
                            {"B", 1000},
                            {"M", 1.85},
                            {"beta", 0.5},
                            {"xi", 3},
                            {"alpha_0", -0.05},
                            {"P_Y", 5000},
                            {"nu_flow", 0.6},
                            {"tensile_strength", 3000}};
  for (const Parameter& p : Model::parameters)
    if (!p.required() && p.name != "A" && p.name != "B" && p.name != "alpha_0")
      values[std::string(p.name)] = p.default_value;
  return Model::make(values);
}

template <class C>
typename C::Point point_at(const Matrix<double, C::D>& F_E,
                           const Matrix<double, C::D>& F_P = Matrix<double, C::D>::identity()) {
  auto p = sample_model<typename C::Model>().template at_rest<typename C::Real, C::D>();
  p.F_E = cast<typename C::Real>(F_E);
  if constexpr (C::plastic) p.F_P = cast<typename C::Real>(F_P);
  return p;
}

/// F with det > 0 whose singular values lie within `strain` of 1.
template <int D>
Matrix<double, D> near_rest(Draw& draw, double strain) {
  return draw.with_singular_values<D>(values_of<D>([&](int) { return 1 + draw.uniform(-strain, strain); }));
}

/// A state inside of the sample model's elastic range, different in each direction. Grains carry nothing
/// unless they are pressed together.
template <class C>
Matrix<double, C::D> elastic_state(Draw& draw) {
  return (C::grains ? 0.97 : 1.0) * near_rest<C::D>(draw, 5e-3);
}

/// The largest difference of two matrices beside `scale`.
template <class T, int D>
double difference(const Matrix<T, D>& a, const Matrix<T, D>& b, double scale) {
  return largest_entry(a - b) / scale;
}

}  // namespace firn::test
