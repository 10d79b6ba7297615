// The particles of one material: a column per quantity, allocated only when required.
//
// A column is cut into tiles of 16 particles, and within a tile its components lie one after another, each 16
// values long. Sixteen particles of one component are one contiguous load for a vector lane, and one
// particle's components are close together for the plain path.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "engine/base/check.h"
#include "engine/math/matrix.h"
#include "engine/particles/columns.h"

namespace firn {

inline constexpr std::size_t kTile = 16;

/// Where component `c` of particle `i` stands in a column of `n` components.
constexpr std::size_t tile_index(std::size_t i, int c, int n) {
  return (i / kTile * static_cast<std::size_t>(n) + static_cast<std::size_t>(c)) * kTile + i % kTile;
}

/// One column of a table. `Real` may be const. Values are Real, Vector or Matrix after the column's rank; a
/// symmetric matrix is stored as its upper triangle.
template <class Real, int D, Rank rank>
class ColumnView {
  using Value = std::remove_const_t<Real>;
  static constexpr int kComponents = components(rank, D);

 public:
  explicit ColumnView(Real* data) : data_(data) {}

  Real& at(std::size_t i, int c) const { return data_[tile_index(i, c, kComponents)]; }

  auto load(std::size_t i) const {
    if constexpr (rank == Rank::scalar) {
      return Value(at(i, 0));
    } else if constexpr (rank == Rank::vector) {
      Vector<Value, D> out;
      for (int c = 0; c < D; ++c) out[c] = at(i, c);
      return out;
    } else {
      Matrix<Value, D> out;
      for (int r = 0; r < D; ++r)
        for (int c = 0; c < D; ++c) out(r, c) = at(i, matrix_component(r, c));
      return out;
    }
  }

  template <class T>
  void store(std::size_t i, const T& value) const {
    if constexpr (rank == Rank::scalar) {
      at(i, 0) = value;
    } else if constexpr (rank == Rank::vector) {
      for (int c = 0; c < D; ++c) at(i, c) = value[c];
    } else {
      for (int r = 0; r < D; ++r)
        for (int c = rank == Rank::symmetric ? r : 0; c < D; ++c) at(i, matrix_component(r, c)) = value(r, c);
    }
  }

 private:
  static constexpr int matrix_component(int r, int c) {
    if constexpr (rank == Rank::symmetric) {
      const int low = r < c ? r : c, high = r < c ? c : r;
      return low * D - low * (low - 1) / 2 + (high - low);
    } else {
      return r * D + c;
    }
  }

  Real* data_;
};

template <class Real, int D>
class ParticleTable {
 public:
  ParticleTable(ColumnSet columns, std::size_t size) : columns_(columns), size_(size), id_(size) {
    for (int c = 0; c < kColumnCount; ++c) {
      const auto column = static_cast<Column>(c);
      if (columns_.has(column)) data_[index(column)].resize(padded(size) * column_width(column));
    }
  }

  std::size_t size() const { return size_; }
  ColumnSet columns() const { return columns_; }

  template <Column c>
  auto view() {
    FIRN_CHECK(columns_.has(c));
    return ColumnView<Real, D, info(c).rank>(data_[index(c)].data());
  }
  template <Column c>
  auto view() const {
    FIRN_CHECK(columns_.has(c));
    return ColumnView<const Real, D, info(c).rank>(data_[index(c)].data());
  }

  /// Never reused and kept through every sort: how a particle is followed from frame to frame.
  std::span<std::uint32_t> id() { return id_; }
  std::span<const std::uint32_t> id() const { return id_; }

  /// Particle i becomes what particle source[i] was.
  void reorder(std::span<const std::uint32_t> source) {
    FIRN_CHECK(source.size() == size_);
    for (int c = 0; c < kColumnCount; ++c) {
      const auto column = static_cast<Column>(c);
      if (columns_.has(column)) reorder_column(data_[index(column)], components(column, D), source);
    }
    std::vector<std::uint32_t> ids(size_);
    for (std::size_t i = 0; i < size_; ++i) ids[i] = id_[source[i]];
    id_.swap(ids);
  }

  /// What a particle with these columns takes, the id included.
  static constexpr std::size_t bytes_per_particle(ColumnSet columns) {
    return static_cast<std::size_t>(columns.reals(D)) * sizeof(Real) + sizeof(std::uint32_t);
  }

 private:
  static constexpr std::size_t index(Column c) { return static_cast<std::size_t>(c); }
  static constexpr std::size_t column_width(Column c) { return static_cast<std::size_t>(components(c, D)); }
  static constexpr std::size_t padded(std::size_t n) { return (n + kTile - 1) / kTile * kTile; }

  void reorder_column(std::vector<Real>& data, int width, std::span<const std::uint32_t> source) {
    scratch_.resize(data.size());
    tbb::parallel_for(std::size_t{0}, (size_ + kTile - 1) / kTile, [&](std::size_t tile) {
      const std::size_t end = std::min(size_, (tile + 1) * kTile);
      for (std::size_t i = tile * kTile; i < end; ++i)
        for (int c = 0; c < width; ++c)
          scratch_[tile_index(i, c, width)] = data[tile_index(source[i], c, width)];
    });
    data.swap(scratch_);
  }

  ColumnSet columns_;
  std::size_t size_;
  std::array<std::vector<Real>, kColumnCount> data_;
  std::vector<Real> scratch_;
  std::vector<std::uint32_t> id_;
};

}  // namespace firn
