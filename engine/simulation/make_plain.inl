#pragma once

#include "engine/scene/with_kernel.h"
#include "engine/simulation/make_plain.h"
#include "engine/simulation/plain_simulation.h"

namespace firn {

/// Transfers with an affine velocity need a kernel that supports one; the plan has seen to it.
template <class Real, int D, class Kernel>
std::unique_ptr<Simulation> make_with_kernel(const Plan& plan, std::span<const Seeds> seeds) {
  const Transfer transfer = plan.scene.simulation.transfer;
  if constexpr (Kernel::affine) {
    if (transfer == Transfer::apic)
      return std::make_unique<PlainSimulation<Real, D, Kernel, ApicTransfer>>(plan, seeds);
    if (transfer == Transfer::mls)
      return std::make_unique<PlainSimulation<Real, D, Kernel, MlsTransfer>>(plan, seeds);
  }
  if (transfer == Transfer::flip)
    return std::make_unique<PlainSimulation<Real, D, Kernel, FlipTransfer>>(plan, seeds);
  FIRN_CHECK(transfer == Transfer::pic);
  return std::make_unique<PlainSimulation<Real, D, Kernel, PicTransfer>>(plan, seeds);
}

template <class Real, int D>
std::unique_ptr<Simulation> make_plain(const Plan& plan, std::span<const Seeds> seeds) {
  return with_kernel(plan.scene.simulation.kernel,
                     [&]<class Kernel>(Kernel) { return make_with_kernel<Real, D, Kernel>(plan, seeds); });
}

}  // namespace firn
