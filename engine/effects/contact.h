// What a wall does to the velocity of a grid node that lies in it.
#pragma once

#include "engine/math/matrix.h"

namespace firn {

enum class Contact {
  sticky,      // moves with the wall
  slip,        // never leaves nor enters: the relative normal velocity is zero
  separating,  // may leave, never enters
};

/// The velocity after contact with a wall moving at `v_wall`, `normal` (unit) pointing out of it. A zero
/// normal, as deep inside a level set where no side is nearer, sticks. Coulomb friction takes at most
/// `friction` times the normal change from the tangential velocity (Stomakhin et al. 2013); it
/// acts for slip and separating.
template <class Real, int D>
Vector<Real, D> contact_velocity(Contact contact, Real friction, const Vector<Real, D>& v,
                                 const Vector<Real, D>& v_wall, const Vector<Real, D>& normal) {
  if (contact == Contact::sticky || dot(normal, normal) == Real(0)) return v_wall;
  const Vector<Real, D> relative = v - v_wall;
  const Real inward = -dot(relative, normal);
  if (contact == Contact::separating && inward <= Real(0)) return v;
  Vector<Real, D> tangential = relative + inward * normal;
  const Real speed = norm(tangential);
  const Real lost = friction * max(inward, Real(0));
  tangential = (speed > lost ? (speed - lost) / speed : Real(0)) * tangential;
  return v_wall + tangential;
}

}  // namespace firn
