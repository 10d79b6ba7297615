#include "engine/particles/particle_table.h"

#include <numeric>

#include <catch2/catch.hpp>

using namespace firn;

TEST_CASE("a column that is not required takes no bytes") {
  const ColumnSet elastic{Column::position, Column::elastic_deformation};
  const ColumnSet snow = elastic | ColumnSet{Column::plastic_deformation};
  CHECK(ParticleTable<float, 3>::bytes_per_particle(elastic) == 4 * (3 + 9) + 4);
  CHECK(ParticleTable<float, 3>::bytes_per_particle(snow) -
            ParticleTable<float, 3>::bytes_per_particle(elastic) ==
        36);
  CHECK(ParticleTable<double, 2>::bytes_per_particle(snow) == 8 * (2 + 4 + 4) + 4);
}

TEST_CASE("what is stored is loaded again, the symmetric stress from its upper triangle") {
  ParticleTable<double, 3> table(
      {Column::position, Column::stress, Column::elastic_deformation, Column::mass}, 37);
  for (std::size_t p = 0; p < 37; ++p) {
    const double k = static_cast<double>(p);
    table.view<Column::mass>().store(p, k);
    table.view<Column::position>().store(p, Vector<double, 3>{k, k + 1, k + 2});
    table.view<Column::elastic_deformation>().store(
        p, Matrix<double, 3>{{{k, 1, 2}, {3, k + 4, 5}, {6, 7, k + 8}}});
    table.view<Column::stress>().store(p, Matrix<double, 3>{{{k, 1, 2}, {1, k + 4, 5}, {2, 5, k + 8}}});
  }
  for (std::size_t p = 0; p < 37; ++p) {
    const double k = static_cast<double>(p);
    REQUIRE(table.view<Column::mass>().load(p) == k);
    REQUIRE(table.view<Column::position>().load(p)[2] == k + 2);
    REQUIRE(table.view<Column::elastic_deformation>().load(p)(2, 1) == 7);
    const auto tau = table.view<Column::stress>().load(p);
    REQUIRE(tau(2, 1) == 5);
    REQUIRE(tau(1, 2) == 5);
    REQUIRE(tau(2, 0) == 2);
    REQUIRE(tau(2, 2) == k + 8);
  }
}

TEST_CASE("reordering moves every column and the ids together") {
  ParticleTable<float, 2> table({Column::position, Column::mass}, 100);
  std::vector<std::uint32_t> source(100);
  for (std::uint32_t p = 0; p < 100; ++p) {
    table.id()[p] = p;
    table.view<Column::mass>().store(p, static_cast<float>(p));
    table.view<Column::position>().store(p, Vector<float, 2>{static_cast<float>(p), -static_cast<float>(p)});
    source[p] = (p * 37) % 100;
  }
  table.reorder(source, ColumnSet::all());
  for (std::uint32_t p = 0; p < 100; ++p) {
    REQUIRE(table.id()[p] == source[p]);
    REQUIRE(table.view<Column::mass>().load(p) == static_cast<float>(source[p]));
    REQUIRE(table.view<Column::position>().load(p)[1] == -static_cast<float>(source[p]));
  }
}
