// The particles of one material: a column per quantity, allocated only when required.
// A column is cut into tiles of 16 particles, and within a tile its components lie one after another.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/cache_aligned_allocator.h>
#include <tbb/parallel_for.h>

#include "engine/base/check.h"
#include "engine/math/matrix.h"
#include "engine/particles/columns.h"
#include "engine/particles/move_tiles.h"

namespace firn {

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
  // Tiles begin on cache lines.
  using Values = std::vector<Real, tbb::cache_aligned_allocator<Real>>;

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

  template <Column c>
  const Real* data() const {
    FIRN_CHECK(columns_.has(c));
    return data_[index(c)].data();
  }
  /// Where each column's tiles begin; null for a column that is not there.
  std::array<Real*, kColumnCount> pointers() {
    std::array<Real*, kColumnCount> out{};
    for (int c = 0; c < kColumnCount; ++c)
      if (columns_.has(static_cast<Column>(c)))
        out[static_cast<std::size_t>(c)] = data_[static_cast<std::size_t>(c)].data();
    return out;
  }

  /// Never reused and kept through every sort: how a particle is followed from frame to frame.
  std::span<std::uint32_t> id() { return id_; }
  std::span<const std::uint32_t> id() const { return id_; }

  /// Particle i becomes what particle source[i] was. Only the columns in `moved` keep their values; the
  /// others lend their memory, and where none is large enough a buffer is taken for the while.
  void reorder(std::span<const std::uint32_t> source, ColumnSet moved,
               MoveTiles<Real> move = move_tiles<Real>) {
    FIRN_CHECK(source.size() == size_);
    Values buffer;
    for (int c = 0; c < kColumnCount; ++c) {
      const auto column = static_cast<Column>(c);
      if (!columns_.has(column) || !moved.has(column)) continue;
      Values& data = data_[index(column)];
      const std::size_t needed = data.size();
      Values* const lent = lender(needed, moved);
      Values& other = lent != nullptr ? *lent : buffer;
      if (other.size() < needed) other.resize(needed);
      move_column(data, other, source, column_width(column), move);
      // The values stand in `other` now. A column of the same size changes places with it; a smaller one is
      // copied back, so that no column ends up with more memory than it needs.
      if (needed == other.size())
        data.swap(other);
      else
        copy(other, data);
    }
    ids_.resize(size_);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size_, 1 << 14), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) ids_[i] = id_[source[i]];
    });
    id_.swap(ids_);
  }

  /// What a particle with these columns takes, the id included.
  static constexpr std::size_t bytes_per_particle(ColumnSet columns) {
    return static_cast<std::size_t>(columns.reals(D)) * sizeof(Real) + sizeof(std::uint32_t);
  }

 private:
  static constexpr std::size_t index(Column c) { return static_cast<std::size_t>(c); }
  static constexpr std::size_t column_width(Column c) { return static_cast<std::size_t>(components(c, D)); }
  static constexpr std::size_t padded(std::size_t n) { return (n + kTile - 1) / kTile * kTile; }

  /// The smallest column that is not in `moved` and has room for `needed` numbers; null when there is none.
  Values* lender(std::size_t needed, ColumnSet moved) {
    Values* out = nullptr;
    for (int c = 0; c < kColumnCount; ++c) {
      Values& data = data_[static_cast<std::size_t>(c)];
      if (moved.has(static_cast<Column>(c)) || data.size() < needed) continue;
      if (out == nullptr || data.size() < out->size()) out = &data;
    }
    return out;
  }

  static void move_column(const Values& from, Values& to, std::span<const std::uint32_t> source,
                          std::size_t width, MoveTiles<Real> move) {
    constexpr std::size_t kGrain = 64;
    const std::size_t whole = source.size() / kTile;
    const auto part = [&](std::size_t tile) { return to.data() + tile * width * kTile; };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, whole, kGrain), [&](const auto& tiles) {
      move(from.data(), part(tiles.begin()), source.data() + tiles.begin() * kTile, tiles.size(),
           static_cast<int>(width));
    });
    move_particles(from.data(), part(whole), source.data() + whole * kTile, source.size() - whole * kTile,
                   static_cast<int>(width));
  }
  static void copy(const Values& from, Values& to) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, to.size(), 1 << 14), [&](const auto& range) {
      std::copy(from.data() + range.begin(), from.data() + range.end(), to.data() + range.begin());
    });
  }

  ColumnSet columns_;
  std::size_t size_;
  std::array<Values, kColumnCount> data_;
  std::vector<std::uint32_t> id_, ids_;
};

}  // namespace firn
