// The effects a scene names, in the order they act on a node. What it does not name has no entry.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "engine/effects/collider.h"
#include "engine/effects/domain_walls.h"
#include "engine/effects/gravity.h"

namespace firn {

struct GridEffects {
  std::optional<Gravity> gravity;
  std::vector<Collider> colliders;
  std::optional<DomainWalls> domain;
};

/// An effect ready for one step.
using StepEffect = std::variant<Gravity, PosedCollider, DomainWalls>;

/// `time`: when the velocities that the effects shape hold, the end of the step.
inline void effects_at(const GridEffects& effects, double time, std::vector<StepEffect>& out) {
  out.clear();
  if (effects.gravity) out.emplace_back(*effects.gravity);
  for (const Collider& collider : effects.colliders) out.emplace_back(PosedCollider(collider, time));
  if (effects.domain) out.emplace_back(*effects.domain);
}

}  // namespace firn
