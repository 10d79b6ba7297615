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

/// The model's defaults; where it has none, a soft solid.
template <class Model>
Model sample_model() {
  ParameterValues values = {{"density", 1000}, {"youngs_modulus", 1.4e5}, {"poissons_ratio", 0.2}};
  for (const Parameter& p : Model::parameters)
    if (!p.required()) values[std::string(p.name)] = p.default_value;
  return Model::make(values);
}

template <class C>
typename C::Point point_at(const Matrix<double, C::D>& F_E,
                           const Matrix<double, C::D>& F_P = Matrix<double, C::D>::identity()) {
  typename C::Point p;
  p.F_E = cast<typename C::Real>(F_E);
  if constexpr (C::plastic) p.F_P = cast<typename C::Real>(F_P);
  return p;
}

/// F with det > 0 whose singular values lie within `strain` of 1.
template <int D>
Matrix<double, D> near_rest(Draw& draw, double strain) {
  return draw.with_singular_values<D>(values_of<D>([&](int) { return 1 + draw.uniform(-strain, strain); }));
}

/// The largest difference of two matrices beside `scale`.
template <class T, int D>
double difference(const Matrix<T, D>& a, const Matrix<T, D>& b, double scale) {
  return largest_entry(a - b) / scale;
}

}  // namespace firn::test
