#include "tools/cli/work_count.h"

#include <catch2/catch.hpp>

#include "engine/math/matrix.h"
#include "tests/materials/model_cases.h"
#include "tools/cli/counting_lane.h"

using namespace firn;

namespace {

using L = CountingLane<float>;

template <class F>
std::int64_t flops_of(F&& f) {
  L::flops = 0;
  f();
  return L::flops;
}

template <class Model>
std::int64_t update_in_3d(Precision precision = Precision::single) {
  return update_flops(test::sample_model<Model>(), 3, precision);
}

}  // namespace

TEST_CASE("each operation is one, and what only picks or moves bits is none", "[bench]") {
  const L a(2), b(3);
  CHECK(flops_of([&] { a + b; }) == 1);
  CHECK(flops_of([&] { (a - b) * a / b; }) == 3);
  CHECK(flops_of([&] { sqrt(a), exp(a), log(a), inverse_sqrt(a), rough_inverse_sqrt(a); }) == 5);
  CHECK(flops_of([&] { select(a < b, min(a, b), max(-a, abs(copysign(a, flip_sign(a, b))))); }) == 0);
}

TEST_CASE("a product of matrices takes D^3 multiplications and D^2 (D - 1) additions", "[bench]") {
  const auto m = Matrix<L, 3>::identity();
  CHECK(flops_of([&] { m* m; }) == 27 + 18);
  const auto n = Matrix<L, 2>::identity();
  CHECK(flops_of([&] { n* n; }) == 8 + 4);
}

TEST_CASE("counting does not change what is computed", "[bench]") {
  for (const double x : {0.3, 2.0, 17.5}) {
    CHECK(sqrt(L(x)).x == firn::sqrt(static_cast<float>(x)));
    CHECK((L(x) / L(3) - exp(L(-x))).x == static_cast<float>(x) / 3.f - firn::exp(static_cast<float>(-x)));
  }
}

TEST_CASE("what a material computes is counted: decomposition, return map, hardening", "[bench]") {
  const std::int64_t decomposition = flops_of([] { svd_any_order(Matrix<L, 3>::identity()); });
  const std::int64_t elastic = update_in_3d<NeoHookean>();
  CHECK(elastic > 45);  // b = F F^T alone
  CHECK(elastic < decomposition);
  CHECK(update_in_3d<StvkHencky>() > decomposition);
  // Counted near rest, where these two need none.
  CHECK(update_in_3d<FixedCorotated>() < decomposition);
  CHECK(update_in_3d<SnowStomakhin2013>() > update_in_3d<FixedCorotated>());
  CHECK(update_flops(test::sample_model<SnowStomakhin2013>(), 2, Precision::single) <
        update_in_3d<SnowStomakhin2013>());
}

TEST_CASE("the material's share does not depend on its parameters", "[bench]") {
  auto soft = test::sample_model<SnowStomakhin2013>(), stiff = soft;
  stiff.moduli.mu *= 10;
  CHECK(update_flops(soft, 3, Precision::single) == update_flops(stiff, 3, Precision::single));
}

TEST_CASE("affine moments cost on top of PIC, and the kernel's gradient on top of moments", "[bench]") {
  for (const int D : {2, 3}) {
    CHECK(transfer_flops(D, Transfer::pic) < transfer_flops(D, Transfer::apic));
    CHECK(transfer_flops(D, Transfer::mls) < transfer_flops(D, Transfer::apic));
  }
}
