// The keys of a path file, as engine/scene/fields.h has those of a scene. Which of them a test takes stands
// in checks.cpp.
#pragma once

#include "engine/scene/fields.h"
#include "tools/cli/path/description.h"

namespace firn {

inline constexpr Range kStrains{.min = -5, .max = 5};

template <class V>
void fields(V& v, LegDescription& d) {
  using enum Need;
  v.choice({"test", required, "what the specimen goes through"}, d.test, kLabTests);
  v.real({"strain", optional, "added over the leg along the axis, logarithmic, or as shear"}, d.strain,
         kStrains);
  v.vector({"strains", optional, "added along x, y (the axis) and z, logarithmic"}, d.strains);
  v.real({"shear", optional, "added beside them"}, d.shear, kStrains);
  v.real({"time", optional, "of the leg", "s"}, d.time, kPositive);
  v.integer({"steps", optional, "of the leg"}, d.steps, {1, 1000000});
  v.real({"pressure", optional, "on all faces at the end, reached evenly", "Pa"}, d.pressure, kAnyNumber);
  v.real({"lateral_pressure", optional, "that the sides keep", "Pa"}, d.lateral_pressure, kAnyNumber);
  v.real({"normal_pressure", optional, "on the sheared face; if left out its height is kept", "Pa"},
         d.normal_pressure, kAnyNumber);
  v.real({"until_stress", optional, "axial, or shear stress, at which the leg ends early", "Pa"},
         d.until_stress, kAnyNumber);
  v.integer({"cycles", optional, "to strain, to -strain and back, so often; time and steps are of a quarter"},
            d.cycles, {1, 10000});
}

template <class V>
void fields(V& v, PathDescription& d) {
  using enum Need;
  v.text({"title", optional, "one line"}, d.title);
  v.text({"description", optional, "what it shows"}, d.description);
  v.section({"material", required, "as one of a scene's materials"}, d.material);
  v.list({"legs", required, "what the specimen goes through, in order"}, d.legs);
}

}  // namespace firn
