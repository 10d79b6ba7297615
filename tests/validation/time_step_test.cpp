// How long a step may be: a free bar of many cells, disturbed in its shortest waves, stays bounded at half of
// the limit that the linearised method has in one dimension, and does not at twice that. The limits, in cells
// that a wave crosses in a step, were computed from the eigenvalues of a step of a regular bar; the worst of
// all offsets of the particles in a cell.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "engine/base/error.h"
#include "tests/support/simulated.h"

namespace firn::test {
namespace {

struct Row {
  const char *kernel, *transfer, *order;
  int per_cell;
  double limit;
};

/// The largest energy over that of the start within 400 steps of `courant` cells; infinite when the run
/// fails.
double growth(const Row& row, double courant) {
  const std::string scene =
      fmt::format(R"toml(
[simulation]
dimension = 1
cell_size = 1
duration = 1
precision = "double"
kernel = "{}"
transfer = "{}"
stress_order = "{}"
mass_cutoff = 0
{}
[materials.m]
model = "stvk_hencky"
density = 1
youngs_modulus = 1
poissons_ratio = 0
[[bodies]]
name = "bar"
material = "m"
shape = {{ type = "box", min = [0, 0, 0], max = [24, 0, 0] }}
sampling = "lattice"
particles_per_cell = {}
velocity = ["1e-6 * (sin(1.9 * x^2) + cos(3 * x))", 0, 0]
)toml",
                  row.kernel, row.transfer, row.order,
                  std::string(row.transfer) == "flip" ? "flip_ratio = 1" : "", row.per_cell);
  Simulated s(scene);
  const auto energy = [&] {
    const FrameTotals t = s.totals();
    return t.kinetic + t.elastic;
  };
  const double start = energy();
  double most = 0;
  try {
    for (int k = 0; k < 400; ++k) {
      s->step(courant);
      most = std::max(most, energy() / start);
    }
  } catch (const Error&) {
    return std::numeric_limits<double>::infinity();
  }
  return most;
}

TEST_CASE("half of the largest stable step is stable, twice that is not") {
  const Row row = GENERATE(Row{"linear", "flip", "usl", 2, 0.756}, Row{"linear", "flip", "musl", 2, 1.43},
                           Row{"linear", "flip", "usf", 2, 1.43}, Row{"gimp", "flip", "usl", 2, 0.756},
                           Row{"gimp", "flip", "usf", 2, 1.75}, Row{"quadratic", "flip", "usl", 1, 0.707},
                           Row{"quadratic", "flip", "usl", 2, 1.04}, Row{"quadratic", "flip", "usf", 2, 2.25},
                           Row{"quadratic", "apic", "usl", 1, 1.0}, Row{"quadratic", "apic", "usl", 2, 1.29},
                           Row{"quadratic", "apic", "usf", 2, 1.56}, Row{"quadratic", "mls", "usl", 2, 1.275},
                           Row{"cubic", "apic", "usl", 2, 1.80}, Row{"cubic", "flip", "usl", 2, 1.51});
  CAPTURE(row.kernel, row.transfer, row.order, row.per_cell);
  // Symplectic steps at half of their limit let the energy of a wave swing by a third at most.
  CHECK(growth(row, 0.5 * row.limit) < 1.5);
  CHECK(growth(row, 2 * row.limit) > 1e3);
}

}  // namespace
}  // namespace firn::test
