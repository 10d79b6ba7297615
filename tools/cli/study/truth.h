// What is true of a scene at the end of a study's runs, at the places where a run's particles started.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/scene/plan.h"
#include "tools/cli/study/description.h"
#include "tools/cli/study/points.h"

namespace firn {

/// Of what errors are taken.
enum StudyQuantity { kDisplacement, kVelocity, kStress, kQuantities };
inline constexpr std::array<std::string_view, kQuantities> kQuantityNames = {"displacement", "velocity",
                                                                             "stress"};

class Truth {
 public:
  virtual ~Truth() = default;

  /// With the particles' own start and mass, everything else as it should be.
  virtual std::vector<BodyPoints> at(const std::vector<BodyPoints>& run) const = 0;

  /// Whether it says anything of that quantity.
  virtual bool knows(StudyQuantity quantity) const = 0;
  /// How far it may itself be off, relative as errors are.
  virtual double uncertainty(StudyQuantity quantity) const = 0;
  /// The order with which the reference runs converge; empty when there are none, or they do not.
  virtual std::optional<double> order(StudyQuantity quantity) const = 0;
  /// One line.
  virtual std::string text() const = 0;
};

/// `time`: when the runs end, s. `plan`: of the study's scene.
std::unique_ptr<Truth> closed_form_truth(const ClosedForm& form, const Plan& plan, double time);

/// `levels`: the reference runs' particles, coarse first, two or three. From three whose differences shrink
/// as those of a method of order 0.5 to 4 do, it is Richardson's extrapolation, with 1.25 times its
/// correction as its uncertainty (the grid convergence index, Roache 1994); else the finest of them, with 3
/// times the last difference. No order above 2 is assumed.
std::unique_ptr<Truth> finest_truth(const FinestRuns& form, std::vector<std::vector<BodyPoints>> levels,
                                    int dimension);

}  // namespace firn
