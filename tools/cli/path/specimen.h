// One material point under total strains, of whatever model: the same state for all of them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/math/matrix.h"
#include "materials/registry.h"

namespace firn {

/// Total strains (tools/cli/path/description.h has the deformation they stand for).
struct Strains {
  Vector<double, 3> log = Vector<double, 3>::zero();
  double gamma = 0;

  Matrix<double, 3> deformation() const;
  double volumetric() const { return log[0] + log[1] + log[2]; }
};

struct SpecimenState {
  Strains strains;
  Matrix<double, 3> F_E, F_P;
  std::array<double, 2> history{};  // in the order of the model's columns
  // What the last step answered.
  Matrix<double, 3> sigma;  // Cauchy's, Pa, positive in tension
  double dissipated = 0;    // J per m^3 at rest, in all
  std::string branch;       // of the last trial state

  double pressure() const;           // Pa, positive in compression
  double equivalent_stress() const;  // sqrt(3/2) |dev sigma|, Pa
};

class Specimen {
 public:
  explicit Specimen(const Material& material) : material_(material) {}

  SpecimenState at_rest() const;
  /// Where the state comes to when it is strained to `strains` within `dt` seconds.
  SpecimenState strained(const SpecimenState& from, const Strains& strains, double dt) const;

  double energy(const SpecimenState& state) const;  // J per m^3 at rest
  Lame<double> moduli() const;                      // Pa, before any hardening
  bool plastic() const;                             // it has an F_P
  std::vector<std::string> history_names() const;

 private:
  const Material& material_;
};

}  // namespace firn
