// The columns a particle can have. A column exists only when the plan's transfer, material or output requires
// it.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "engine/base/check.h"

namespace firn {

enum class Column : std::uint8_t {
  position,             // x, m
  velocity,             // v, m/s
  affine,               // C = B D^-1, 1/s: the affine part of the velocity (APIC)
  mass,                 // m, kg (kg/m in 2D, kg/m^2 in 1D)
  volume,               // V0, m^D: volume at rest
  elastic_deformation,  // F_E
  plastic_deformation,  // F_P
  hardening,            // alpha: what a yield surface hardens with; its model says what it means
  volume_gain,          // v_c: logarithmic volume by which matter has come apart
  stress,               // tau, Pa: Kirchhoff stress, symmetric
  force,                // f, N: from outside, on the particle itself
};
inline constexpr int kColumnCount = 11;

enum class Rank : std::uint8_t { scalar, vector, matrix, symmetric };

struct ColumnInfo {
  std::string_view name, symbol, unit;
  Rank rank;
};

inline constexpr std::array<ColumnInfo, kColumnCount> kColumnInfo = {{
    {"position", "x", "m", Rank::vector},
    {"velocity", "v", "m/s", Rank::vector},
    {"affine velocity", "C", "1/s", Rank::matrix},
    {"mass", "m", "kg", Rank::scalar},
    {"rest volume", "V0", "m^D", Rank::scalar},
    {"elastic deformation", "F_E", "-", Rank::matrix},
    {"plastic deformation", "F_P", "-", Rank::matrix},
    {"hardening variable", "alpha", "-", Rank::scalar},
    {"volume gain", "v_c", "-", Rank::scalar},
    {"Kirchhoff stress", "tau", "Pa", Rank::symmetric},
    {"force", "f", "N", Rank::vector},
}};

constexpr const ColumnInfo& info(Column c) {
  return kColumnInfo[static_cast<std::size_t>(c)];
}

/// Real numbers per particle in dimension `d`.
constexpr int components(Rank rank, int d) {
  switch (rank) {
    case Rank::scalar:
      return 1;
    case Rank::vector:
      return d;
    case Rank::matrix:
      return d * d;
    case Rank::symmetric:
      return d * (d + 1) / 2;
  }
  return 0;
}
constexpr int components(Column c, int d) {
  return components(info(c).rank, d);
}

/// A set of columns; usable at compile time, so that a material states what it needs in its type.
class ColumnSet {
 public:
  constexpr ColumnSet() = default;
  constexpr ColumnSet(std::initializer_list<Column> columns) {
    for (Column c : columns) bits_ |= bit(c);
  }
  static constexpr ColumnSet all() {
    ColumnSet out;
    out.bits_ = (std::uint32_t{1} << kColumnCount) - 1;
    return out;
  }
  constexpr ColumnSet without(Column c) const {
    ColumnSet out = *this;
    out.bits_ &= ~bit(c);
    return out;
  }
  constexpr bool has(Column c) const { return (bits_ & bit(c)) != 0; }
  constexpr bool includes(ColumnSet other) const { return (other.bits_ & ~bits_) == 0; }
  friend constexpr ColumnSet operator|(ColumnSet a, ColumnSet b) {
    ColumnSet out;
    out.bits_ = a.bits_ | b.bits_;
    return out;
  }
  friend constexpr ColumnSet operator&(ColumnSet a, ColumnSet b) {
    ColumnSet out;
    out.bits_ = a.bits_ & b.bits_;
    return out;
  }
  friend constexpr bool operator==(ColumnSet, ColumnSet) = default;

  /// Real numbers per particle of all columns together.
  constexpr int reals(int d) const {
    int sum = 0;
    for (int c = 0; c < kColumnCount; ++c) {
      const auto column = static_cast<Column>(c);
      if (has(column)) sum += components(column, d);
    }
    return sum;
  }

 private:
  static constexpr std::uint32_t bit(Column c) { return std::uint32_t{1} << static_cast<unsigned>(c); }
  std::uint32_t bits_ = 0;
};

/// What a material reads and changes of a particle: its deformation and its history.
inline constexpr ColumnSet kMaterialState{Column::elastic_deformation, Column::plastic_deformation,
                                          Column::hardening, Column::volume_gain};

}  // namespace firn
