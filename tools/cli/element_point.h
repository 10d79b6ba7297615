// What can be told of a material's point without knowing its model.
#pragma once

#include <string>

#include "engine/math/svd.h"
#include "materials/flow_plastic.h"
#include "materials/model_info.h"

namespace firn {

/// What the scene and papers call the history of a model: "q" of sand, else "alpha".
std::string_view history_name(const ModelInfo& model, Column column);

template <class Point>
constexpr bool has_plastic_part = Point::columns.has(Column::plastic_deformation);

/// Which case of its return map a trial state falls into.
template <int D, class Model, class Point>
std::string branch_of(const Model& model, const Point& trial, double dt) {
  if constexpr (requires { model.yield; }) {
    return model.yield.branch(svd(trial.F_E).s);
  } else if constexpr (requires { model.flow; }) {
    const Stretches<double, D> stretches(svd_any_order(trial.F_E).s);
    return model.flow.branch(stretches.s, model.moduli, trial.history, dt);
  } else {
    return "elastic";
  }
}

/// Calls f(name, number) for each history variable of the point.
template <class Model, class Point, class F>
void visit_history(Point& point, F&& f) {
  const ModelInfo& model = *find_model(Model::name);
  point.visit([&](auto column, auto& value) {
    if constexpr (info(column()).rank == Rank::scalar) f(std::string(history_name(model, column())), value);
  });
}

}  // namespace firn
