// The effects a scene names, in the order they act on a node. What it does not name has no entry.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "engine/effects/domain_walls.h"
#include "engine/effects/gravity.h"
#include "engine/effects/still_collider.h"

namespace firn {

struct GridEffects {
  std::optional<Gravity> gravity;
  std::vector<Collider> colliders;
  std::optional<DomainWalls> domain;
};

/// An effect ready for one step.
template <class Real, int D>
using StepEffect = std::variant<Gravity, PosedCollider, const StillCollider<Real, D>*, DomainWalls>;

/// `time`: when the velocities that the effects shape hold, the end of the step. `still`: the colliders that
/// never move, in their order, or none of them.
template <class Real, int D>
void effects_at(const GridEffects& effects, double time, std::span<const StillCollider<Real, D>> still,
                std::vector<StepEffect<Real, D>>& out) {
  out.clear();
  if (effects.gravity) out.emplace_back(*effects.gravity);
  for (const Collider& collider : effects.colliders)
    if (collider.motion.still() && !still.empty()) {
      out.emplace_back(&still.front());
      still = still.subspan(1);
    } else {
      out.emplace_back(PosedCollider(collider, time));
    }
  if (effects.domain) out.emplace_back(*effects.domain);
}

template <class Real, int D>
void apply(const StepEffect<Real, D>& effect, BlockNodes<Real, D>& block, double dt) {
  std::visit(
      [&]<class Effect>(const Effect& e) {
        if constexpr (std::is_pointer_v<Effect>)
          e->apply(block, dt);
        else
          e.apply(block, dt);
      },
      effect);
}

}  // namespace firn
