// What moves between particles and grid. A scheme is a type: what it does not need is neither stored nor
// computed.
#pragma once

#include <string_view>

#include "engine/particles/columns.h"

namespace firn {

/// Particle velocity = grid velocity (Harlow 1964). Stable, and loses angular momentum every step.
struct PicTransfer {
  static constexpr std::string_view name = "pic";
  static constexpr ColumnSet columns{};
  static constexpr bool affine = false;
  static constexpr bool increments = false;
  static constexpr bool moments = false;
};

/// Particle velocity += change of the grid velocity, blended: (1 - ratio) PIC + ratio FLIP (Brackbill &
/// Ruppel 1986).
struct FlipTransfer {
  static constexpr std::string_view name = "flip";
  static constexpr ColumnSet columns{};
  static constexpr bool affine = false;
  static constexpr bool increments = true;  // keeps the grid velocity from before the forces
  static constexpr bool moments = false;
};

/// PIC with the affine velocity C = B D^-1 carried by each particle (Jiang et al. 2015): keeps angular
/// momentum.
struct ApicTransfer {
  static constexpr std::string_view name = "apic";
  static constexpr ColumnSet columns{Column::affine};
  static constexpr bool affine = true;
  static constexpr bool increments = false;
  static constexpr bool moments = false;  // the gradient of the kernel carries forces and strain
};

/// APIC whose forces and velocity gradient come from the affine moments instead of the kernel's gradient
/// (MLS-MPM, Hu et al. 2018): grad S is replaced by D^-1 S (x_i - x_p). Cheaper, and of the same order.
struct MlsTransfer {
  static constexpr std::string_view name = "mls";
  static constexpr ColumnSet columns{Column::affine};
  static constexpr bool affine = true;
  static constexpr bool increments = false;
  static constexpr bool moments = true;
};

/// Of FLIP when the scene does not say: enough PIC to let the noise between particles and grid die out.
inline constexpr double kDefaultFlipRatio = 0.99;

/// The columns every scheme moves.
inline constexpr ColumnSet kTransferColumns{Column::position, Column::velocity, Column::mass,
                                            Column::volume,   Column::stress,   Column::elastic_deformation};

}  // namespace firn
