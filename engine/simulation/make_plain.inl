#pragma once

#include "engine/simulation/make_plain.h"
#include "engine/simulation/plain_simulation.h"

namespace firn {

template <class Real, int D>
std::unique_ptr<Simulation> make_plain(const Plan& plan, std::span<const Seeds> seeds) {
  switch (plan.scene.simulation.transfer) {
    case Transfer::pic:
      return std::make_unique<PlainSimulation<Real, D, QuadraticKernel, PicTransfer>>(plan, seeds);
    case Transfer::flip:
      return std::make_unique<PlainSimulation<Real, D, QuadraticKernel, FlipTransfer>>(plan, seeds);
    case Transfer::mls:
      return std::make_unique<PlainSimulation<Real, D, QuadraticKernel, MlsTransfer>>(plan, seeds);
    case Transfer::apic:
      break;
  }
  return std::make_unique<PlainSimulation<Real, D, QuadraticKernel, ApicTransfer>>(plan, seeds);
}

}  // namespace firn
