#include "tools/cli/path/path.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/output/checked_file.h"
#include "engine/scene/plan.h"
#include "tools/cli/path/reader.h"
#include "tools/cli/path/walk.h"

namespace firn {
namespace {

class Csv {
 public:
  Csv(const Specimen& specimen, std::ostream& out)
      : specimen_(specimen), out_(out), history_(specimen.history_names()) {
    out_ << "step,time,leg";
    for (const char row : {'x', 'y', 'z'})
      for (const char column : {'x', 'y', 'z'}) out_ << ",F_" << row << column;
    out_ << ",strain_axial,strain_lateral,gamma,strain_volumetric"
            ",stress_xx,stress_yy,stress_zz,stress_xy,p,q";
    for (const std::string& name : history_) out_ << ",state_" << name;
    out_ << (specimen.plastic() ? ",J_P" : "") << ",psi,dissipated,branch\n";
  }

  void row(const PathPlace& place, const SpecimenState& s) {
    out_ << fmt::format("{},{},{}", place.step, place.time, place.leg);
    const Matrix<double, 3> F = s.strains.deformation();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) number(F(i, j));
    const Vector<double, 3>& e = s.strains.log;
    for (const double x : {e[1], (e[0] + e[2]) / 2, s.strains.gamma, s.strains.volumetric(), s.sigma(0, 0),
                           s.sigma(1, 1), s.sigma(2, 2), s.sigma(0, 1), s.pressure(), s.equivalent_stress()})
      number(x);
    for (std::size_t k = 0; k < history_.size(); ++k) number(s.history[k]);
    if (specimen_.plastic()) number(determinant(s.F_P));
    number(specimen_.energy(s));
    number(s.dissipated);
    out_ << ',' << s.branch << '\n';
  }

 private:
  // Not "-0".
  void number(double x) { out_ << fmt::format(",{}", x + 0.0); }

  const Specimen& specimen_;
  std::ostream& out_;
  std::vector<std::string> history_;
};

void write_rows(const PathDescription& path, const Material& material, std::ostream& out) {
  const Specimen specimen(material);
  Csv csv(specimen, out);
  walk(path, specimen, [&](const PathPlace& place, const SpecimenState& s) { csv.row(place, s); });
}

}  // namespace

int run_element_path(const PathOptions& options, std::ostream& out) {
  const PathDescription path = read_path(options.path, options.overrides);
  const Material material = make_material(path.material);
  if (options.out.empty()) {
    write_rows(path, material, out);
    return 0;
  }
  CheckedFile file(options.out);
  try {
    write_rows(path, material, file.stream());
  } catch (const Error& error) {
    if (error.code() == ExitCode::numerics) file.commit();
    throw;
  }
  file.commit();
  return 0;
}

}  // namespace firn
