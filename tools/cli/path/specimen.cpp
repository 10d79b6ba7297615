#include "tools/cli/path/specimen.h"

#include <cmath>

#include "tools/cli/element_point.h"

namespace firn {
namespace {

/// Calls f(what the model's point has, what the state has) for each column.
template <class Point, class State, class F>
void visit_both(Point& point, State& state, F&& f) {
  std::size_t next = 0;
  point.visit([&](auto column, auto& value) {
    if constexpr (column() == Column::elastic_deformation) {
      f(value, state.F_E);
    } else if constexpr (column() == Column::plastic_deformation) {
      f(value, state.F_P);
    } else {
      f(value, state.history[next++]);
    }
  });
}

template <class Model>
auto point_of(const Model& model, const SpecimenState& state) {
  auto point = model.template at_rest<double, 3>();
  visit_both(point, state, [](auto& of_point, const auto& of_state) { of_point = of_state; });
  return point;
}

template <class Model>
void update(const Model& model, SpecimenState& state, double dt) {
  auto point = point_of(model, state);
  state.branch = branch_of<3>(model, point, dt);
  const Response<double, 3> response = model.update(point, dt);
  visit_both(point, state, [](const auto& of_point, auto& of_state) { of_state = of_point; });
  state.sigma = std::exp(-state.strains.volumetric()) * response.tau;
  state.dissipated += response.dissipated;
}

}  // namespace

Matrix<double, 3> Strains::deformation() const {
  auto F = Matrix<double, 3>::diagonal({std::exp(log[0]), std::exp(log[1]), std::exp(log[2])});
  F(0, 1) = gamma * F(1, 1);
  return F;
}

double SpecimenState::pressure() const {
  return -trace(sigma) / 3;
}

double SpecimenState::equivalent_stress() const {
  return std::sqrt(1.5 * frobenius2(sigma + Matrix<double, 3>::scaled_identity(pressure())));
}

SpecimenState Specimen::at_rest() const {
  return std::visit(
      [](const auto& model) {
        SpecimenState out;
        out.F_P = Matrix<double, 3>::identity();
        auto point = model.template at_rest<double, 3>();
        visit_both(point, out, [](const auto& of_point, auto& of_state) { of_state = of_point; });
        update(model, out, 0);
        return out;
      },
      material_);
}

SpecimenState Specimen::strained(const SpecimenState& from, const Strains& strains, double dt) const {
  SpecimenState out = from;
  out.strains = strains;
  out.F_E = strains.deformation() * (inverse(from.strains.deformation()) * from.F_E);
  std::visit([&](const auto& model) { update(model, out, dt); }, material_);
  return out;
}

double Specimen::energy(const SpecimenState& state) const {
  return std::visit([&](const auto& model) { return double(model.energy(point_of(model, state))); },
                    material_);
}

Lame<double> Specimen::moduli() const {
  return std::visit([](const auto& model) { return model.moduli; }, material_);
}

bool Specimen::plastic() const {
  return std::visit(
      [](const auto& model) { return has_plastic_part<decltype(model.template at_rest<double, 3>())>; },
      material_);
}

std::vector<std::string> Specimen::history_names() const {
  std::vector<std::string> out;
  std::visit(
      [&](const auto& model) {
        auto point = model.template at_rest<double, 3>();
        visit_history<std::remove_cvref_t<decltype(model)>>(
            point, [&](const std::string& name, double) { out.push_back(name); });
      },
      material_);
  return out;
}

}  // namespace firn
