// A point led along a path of velocity gradients, for the tests of single models.
#pragma once

#include "tests/materials/model_cases.h"

namespace firn::test {

template <class Model, int D>
struct Led {
  Model model;
  typename Model::template Point<double, D> point;
  Response<double, D> response{};

  explicit Led(const Model& m) : model(m), point(m.template at_rest<double, D>()) {}

  void step(const Matrix<double, D>& increment, double dt) {
    point.F_E = (Matrix<double, D>::identity() + increment) * point.F_E;
    response = model.update(point, dt);
  }
  /// Scales every length by exp(strain) in so many steps.
  void swell(double strain, int steps, double dt = 1e-3) {
    for (int n = 0; n < steps; ++n) step(Matrix<double, D>::scaled_identity(std::expm1(strain / steps)), dt);
  }
  /// Simple shear: dx_0 = gamma x_1.
  void shear(double gamma, int steps, double time) {
    auto increment = Matrix<double, D>::zero();
    increment(0, 1) = gamma / steps;
    for (int n = 0; n < steps; ++n) step(increment, time / steps);
  }
  /// Pure shear: exp(+-strain) along the first two axes.
  void stretch(double strain, int steps, double time) {
    auto increment = Matrix<double, D>::zero();
    increment(0, 0) = std::expm1(strain / steps), increment(1, 1) = std::expm1(-strain / steps);
    for (int n = 0; n < steps; ++n) step(increment, time / steps);
  }

  double pressure() const { return -trace(response.tau) / D; }
  /// sqrt(3/2) |dev tau|.
  double equivalent_stress() const {
    const Matrix<double, D> dev = response.tau + Matrix<double, D>::scaled_identity(pressure());
    return std::sqrt(1.5 * frobenius2(dev));
  }
};

template <class Model>
Model make_model(ParameterValues values) {
  for (const Parameter& p : Model::parameters) values.try_emplace(std::string(p.name), p.default_value);
  return Model::make(values);
}

}  // namespace firn::test
