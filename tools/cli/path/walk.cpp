#include "tools/cli/path/walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/scene/scene_text.h"
#include "tools/cli/path/leg.h"
#include "tools/cli/path/solve.h"

namespace firn {
namespace {

// What has come apart stretches without end towards a stress of zero: so much in a step is no answer.
constexpr double kFarthest = 1;
constexpr double kAccuracy = 1e-8;  // of a driven stress, over the P-wave modulus

class Walk {
 public:
  Walk(const PathDescription& path, const Specimen& specimen, const PathRow& row)
      : path_(path),
        specimen_(specimen),
        row_(row),
        scale_(specimen.moduli().p_wave()),
        state_(specimen.at_rest()) {}

  void run() {
    row_(place_, state_);
    for (place_.leg = 0; place_.leg < path_.legs.size(); ++place_.leg) run_leg();
  }

 private:
  const LegDescription& leg() const { return path_.legs[place_.leg]; }

  void run_leg() {
    const bool early = leg().until_stress.has_value();
    for (const Way& way : ways(leg(), state_, 1e-12 * scale_)) {
      start_ = state_.strains;
      start_time_ = place_.time;
      last_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(way.stresses.size()));
      for (int k = 0; k < way.steps; ++k)
        if (run_step(way, k)) return;
    }
    if (early)
      fail(fmt::format("the stress ends at {:g} Pa and has not reached until_stress, {:g} Pa", driven(state_),
                       *leg().until_stress));
  }

  /// True where the leg ends early.
  bool run_step(const Way& way, int k) {
    ++place_.step;
    double part = 1;
    Attempt end = attempt(way, k, part);
    check(end.residual, "the stress on the faces cannot be what it should be");
    const bool last = leg().until_stress && passes(state_, end.state);
    if (last) {
      const auto missing = [&](double p) {
        return (driven(p == 0 ? state_ : attempt(way, k, p).state) - *leg().until_stress) / scale_;
      };
      part = crossing(missing);
      end = attempt(way, k, part);
      check(std::max(end.residual, std::abs(missing(part))), "the stress jumps over until_stress");
    }
    place_.time = start_time_ + (k + part) / way.steps * way.time;
    last_ = end.strains_found;
    state_ = end.state;
    row_(place_, state_);
    return last;
  }

  struct Attempt {
    SpecimenState state;
    Eigen::VectorXd strains_found;
    double residual;
  };

  /// The first `part` of step k of the way.
  Attempt attempt(const Way& way, int k, double part) const {
    const double share = (k + part) / way.steps;
    Strains driven = start_;
    driven.log += share * way.strains.log;
    driven.gamma += share * way.strains.gamma;
    for (const DrivenStress& d : way.stresses)
      for (const int axis : d.axes) driven.log[axis] = state_.strains.log[axis];
    const auto state_with = [&](const Eigen::VectorXd& found) {
      Strains strains = driven;
      for (std::size_t g = 0; g < way.stresses.size(); ++g)
        for (const int axis : way.stresses[g].axes) strains.log[axis] += found[static_cast<Eigen::Index>(g)];
      return specimen_.strained(state_, strains, part / way.steps * way.time);
    };
    const double farthest = kFarthest * (1 + size(way) / way.steps);
    const auto residual = [&](const Eigen::VectorXd& found) -> Eigen::VectorXd {
      if (found.cwiseAbs().maxCoeff() > farthest)
        return Eigen::VectorXd::Constant(found.size(), std::numeric_limits<double>::infinity());
      const SpecimenState state = state_with(found);
      Eigen::VectorXd out(found.size());
      for (std::size_t g = 0; g < way.stresses.size(); ++g) {
        const DrivenStress& d = way.stresses[g];
        const double wanted = d.from + share * (d.to - d.from);
        out[static_cast<Eigen::Index>(g)] = (state.sigma(d.axes[0], d.axes[0]) - wanted) / scale_;
      }
      return out;
    };
    const Root root = solve(residual, part * last_, elastic_slope(way.stresses));
    return {state_with(root.x), root.x, root.residual};
  }

  /// The largest strain that is driven over the way.
  static double size(const Way& way) {
    double out = std::abs(way.strains.gamma);
    for (int axis = 0; axis < 3; ++axis) out = std::max(out, std::abs(way.strains.log[axis]));
    return out;
  }

  Eigen::MatrixXd elastic_slope(const std::vector<DrivenStress>& stresses) const {
    const auto n = static_cast<Eigen::Index>(stresses.size());
    const Lame<double> m = specimen_.moduli();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t g = 0; g < stresses.size(); ++g)
      for (std::size_t h = 0; h < stresses.size(); ++h)
        for (const int axis : stresses[h].axes)
          out(static_cast<Eigen::Index>(g), static_cast<Eigen::Index>(h)) +=
              (axis == stresses[g].axes[0] ? m.p_wave() : m.lam) / scale_;
    return out;
  }

  double driven(const SpecimenState& state) const { return driven_stress(leg(), state); }

  bool passes(const SpecimenState& before, const SpecimenState& after) const {
    const double a = driven(before) - *leg().until_stress, b = driven(after) - *leg().until_stress;
    return b == 0 || (a < 0) != (b < 0);
  }

  void check(double residual, std::string_view what) const {
    if (residual <= kAccuracy) return;
    fail(fmt::format(
        "{}: {:.3g} Pa are left, allowed: {:.3g} Pa, 1e-8 of the P-wave modulus; smaller steps may help",
        what, residual * scale_, kAccuracy * scale_));
  }

  [[noreturn]] void fail(const std::string& why) const {
    const SourceMark& mark = leg().mark;
    throw Error(ExitCode::numerics, fmt::format("{}:{}:{}: legs[{}]: step {}: {}", mark.file, mark.line,
                                                mark.column, place_.leg, place_.step, why));
  }

  const PathDescription& path_;
  const Specimen& specimen_;
  const PathRow& row_;
  double scale_;  // Pa
  PathPlace place_;
  SpecimenState state_;
  Strains start_;  // of the way
  double start_time_ = 0;
  Eigen::VectorXd last_;  // what the step before found
};

}  // namespace

void walk(const PathDescription& path, const Specimen& specimen, const PathRow& row) {
  Walk(path, specimen, row).run();
}

}  // namespace firn
