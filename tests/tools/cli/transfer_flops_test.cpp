// The transfers' formula against their arithmetic, done once more on numbers that count: line by line what
// engine/vector/row_kernels.h does with the rows of a particle, and transfer_kernels.h with the particle.
#include <algorithm>

#include <catch2/catch.hpp>

#include "tools/cli/counting_lane.h"
#include "tools/cli/work_count.h"

using namespace firn;

namespace {

using L = CountingLane<double>;

/// Three nodes of n numbers. The numbers do not matter, nor does which weight is which.
template <int n>
struct Row {
  L x[3 * n];
  Row() { std::fill(std::begin(x), std::end(x), L(0.5)); }

  template <class F>
  static Row each(F&& f) {
    Row out;
    for (int k = 0; k < 3 * n; ++k) out.x[k] = f(k);
    return out;
  }
  friend Row operator+(const Row& a, const Row& b) {
    return each([&](int k) { return a.x[k] + b.x[k]; });
  }
  friend Row operator-(const Row& a, const Row& b) {
    return each([&](int k) { return a.x[k] - b.x[k]; });
  }
  friend Row operator*(L w, const Row& a) {
    return each([&](int k) { return w * a.x[k]; });
  }
  void sum() const {
    for (int k = 0; k < n; ++k) x[k] + x[n + k] + x[2 * n + k];
  }
  void last_less_first() const {
    for (int k = 0; k < n; ++k) x[2 * n + k] - x[k];
  }
};

const L w(0.25);

template <int D, bool affine, bool gradient>
void gather_rows() {
  using R = Row<D>;
  const R node;
  const auto weighted = [](const R& a, const R& b, const R& c) { return w * a + (w * b + w * c); };
  R s[3], y[3], gy[3];
  if (D == 3)
    for (int i = 0; i < 3; ++i) {
      const R low = w * node, high = w * node;
      s[i] = w * node + (low + high);
      if (affine) y[i] = high - low;
      if (gradient) gy[i] = weighted(node, node, node);
    }
  const R low = w * s[0], high = w * s[2], across = w * s[1] + (low + high), sum = w * across;
  sum.sum();
  if (affine) {
    (w * (high - low)).sum();
    if (D == 3) (w * weighted(y[0], y[1], y[2])).sum();
    sum.last_less_first();
  }
  if (gradient) {
    (w * weighted(s[0], s[1], s[2])).sum();
    if (D == 3) (w * weighted(gy[0], gy[1], gy[2])).sum();
    (w * across).sum();
  }
}

template <int D, bool affine, bool gradient>
void scatter_rows() {
  using V = Row<D>;  // moments and gradients have no mass
  using R = Row<D + 1>;
  const V record;
  const R value = w * R();
  if (affine) w* record + V();
  if (gradient) w* record + V();
  V x, tx, y, ty;
  if (affine) x = w * record;
  if (gradient) tx = w * record;
  if (affine && D == 3) y = w * record;
  if (gradient && D == 3) ty = w * record;
  for (int i = 0; i < 3; ++i) {
    if (affine && i != 1) V() + x;
    const R line = w * value;
    if (gradient) w* tx + V();
    if (D == 2) {
      R() + line;
      continue;
    }
    if (affine) w* y;
    if (gradient) w* ty;
    for (int j = 0; j < 3; ++j) {
      if (affine && j != 1) V() + y;
      w* line + R();
      if (gradient) w* ty + V();
    }
  }
}

void place(int D) {
  for (int d = 0; d < D; ++d) {
    const L cell = w * w, base = cell - w, x = cell - base - w, low = w - x, high = w + x;
    w *low *low, w - x *x, w *high *high;
  }
}

template <int D, bool affine, bool gradient>
void step() {
  const L x(1);
  place(D);
  gather_rows<D, affine, gradient>();
  for (int c = 0; c < D; ++c) {
    for (int d = 0; d < D; ++d) {
      if (affine) w*(x - w * x);
      w* x;  // dt grad v
    }
    x + w* x;
  }
  for (int entry = 0; entry < D * D; ++entry)
    for (int k = 0; k < D; ++k) x + w* x;
  place(D);
  w* x;
  if (affine) w* x;
  for (int c = 0; c < D; ++c) {
    w* x;  // m v
    for (int d = 0; d < D; ++d) {
      w* x;  // T
      if (affine) w* x;
      if (!gradient) x + w* x;
      if (affine) x - w* x;
    }
  }
  scatter_rows<D, affine, gradient>();
}

template <int D, bool affine, bool gradient>
std::int64_t counted() {
  L::flops = 0;
  step<D, affine, gradient>();
  return L::flops;
}

}  // namespace

TEST_CASE("the transfers' operations are those of the row kernels", "[bench]") {
  CHECK(transfer_flops(2, Transfer::pic) == counted<2, false, true>());
  CHECK(transfer_flops(2, Transfer::apic) == counted<2, true, true>());
  CHECK(transfer_flops(2, Transfer::mls) == counted<2, true, false>());
  CHECK(transfer_flops(3, Transfer::pic) == counted<3, false, true>());
  CHECK(transfer_flops(3, Transfer::apic) == counted<3, true, true>());
  CHECK(transfer_flops(3, Transfer::mls) == counted<3, true, false>());
}
