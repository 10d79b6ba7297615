#include "tools/cli/path/leg.h"

#include <cmath>

namespace firn {
namespace {

enum Axis { x, y, z };

/// Along these axes nothing tells one from another: what they do they do together. Else each for itself,
/// `to` being wanted on all of them.
std::vector<DrivenStress> driven(const std::vector<int>& axes, const SpecimenState& s, double accuracy,
                                 const auto& from, const auto& to) {
  bool alike = s.strains.gamma == 0;
  for (const int a : axes)
    alike = alike && s.strains.log[a] == s.strains.log[axes[0]] &&
            std::abs(s.sigma(a, a) - s.sigma(axes[0], axes[0])) < accuracy;
  if (alike) return {{axes, from(axes[0]), to(axes[0])}};
  std::vector<DrivenStress> out;
  for (const int a : axes) out.push_back({{a}, from(a), to(a)});
  return out;
}

std::vector<DrivenStress> stresses(const LegDescription& leg, const SpecimenState& s, double accuracy) {
  const auto present = [&](int axis) { return s.sigma(axis, axis); };
  const auto pressed = [](double pressure) { return [=](int) { return -pressure; }; };
  switch (leg.test) {
    case LabTest::uniaxial:
      return driven({x, z}, s, accuracy, pressed(0), pressed(0));
    case LabTest::triaxial:
      if (!leg.lateral_pressure) return driven({x, z}, s, accuracy, present, present);
      return driven({x, z}, s, accuracy, pressed(*leg.lateral_pressure), pressed(*leg.lateral_pressure));
    case LabTest::isotropic:
      return driven({x, y, z}, s, accuracy, present, pressed(*leg.pressure));
    case LabTest::simple_shear:
      if (leg.normal_pressure) return {{{y}, -*leg.normal_pressure, -*leg.normal_pressure}};
      return {};
    case LabTest::oedometer:
    case LabTest::free:
      return {};
  }
  return {};
}

Strains strains(const LegDescription& leg) {
  Strains out;
  if (leg.test == LabTest::free) {
    out.log = {leg.strains[x], leg.strains[y], leg.strains[z]};
    out.gamma = leg.shear;
  } else if (leg.test == LabTest::simple_shear) {
    out.gamma = leg.strain.value_or(0);
  } else {
    out.log[y] = leg.strain.value_or(0);
  }
  return out;
}

Way scaled(Way way, int factor) {
  way.strains.log = double(factor) * way.strains.log;
  way.strains.gamma *= factor;
  way.time *= std::abs(factor);
  way.steps *= std::abs(factor);
  return way;
}

}  // namespace

std::vector<Way> ways(const LegDescription& leg, const SpecimenState& state, double accuracy) {
  const Way once = {strains(leg), stresses(leg, state, accuracy), leg.time, leg.steps};
  if (!leg.cycles) return {once};
  std::vector<Way> out;
  for (int cycle = 0; cycle < *leg.cycles; ++cycle)
    for (const int factor : {1, -2, 1}) out.push_back(scaled(once, factor));
  return out;
}

double driven_stress(const LegDescription& leg, const SpecimenState& state) {
  return leg.test == LabTest::simple_shear ? state.sigma(x, y) : state.sigma(y, y);
}

}  // namespace firn
