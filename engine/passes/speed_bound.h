// How fast a particle can become in the step at hand, from the grid alone: what must be known before the
// particles move.
//
// A particle's velocity is the mean of its nodes' with the weights w_i. Nodes that hardly any mass reaches
// can be very fast, for the kernel's gradient falls slower than its weight; but a particle weighs such a node
// no more than w_i <= m_i / m_p. So a component is bounded by the fastest of the heavy nodes plus, for each
// of at most 3^D light ones, |v_i| m_i / m_p.
#pragma once

#include <algorithm>

namespace firn {

struct SpeedBound {
  double heavy = 0, light = 0;  // m/s; not finite when a velocity is not

  void join(const SpeedBound& other) {
    heavy = std::max(heavy, other.heavy);
    light = std::max(light, other.light);
  }
  double value() const { return heavy + light; }
};

}  // namespace firn
