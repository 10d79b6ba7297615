#include "engine/effects/contact.h"

#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "engine/effects/grid_effects.h"
#include "engine/shapes/primitives.h"

using namespace firn;
using V = Vector<double, 3>;

namespace {

struct HalfSpace final : Shape {
  void distance(std::span<const Vec3> points, std::span<double> phi) const override {
    for (std::size_t i = 0; i < points.size(); ++i) phi[i] = points[i].y();
  }
  Bounds bounds() const override {
    const double far = std::numeric_limits<double>::infinity();
    return {Vec3(-far, -far, -far), Vec3(far, 0, far)};
  }
};

void check_equal(const V& a, const V& b) {
  for (int d = 0; d < 3; ++d) CHECK(a[d] == Approx(b[d]).margin(1e-14));
}

}  // namespace

TEST_CASE("each contact condition does to a velocity what its name says") {
  const V normal{0, 1, 0}, wall{0.5, 0, 0}, in{2, -1, 0}, out{2, 1, 0};
  check_equal(contact_velocity(Contact::sticky, 0.0, in, wall, normal), wall);
  check_equal(contact_velocity(Contact::slip, 0.0, in, wall, normal), {2, 0, 0});
  check_equal(contact_velocity(Contact::slip, 0.0, out, wall, normal), {2, 0, 0});
  check_equal(contact_velocity(Contact::separating, 0.0, in, wall, normal), {2, 0, 0});
  check_equal(contact_velocity(Contact::separating, 0.0, out, wall, normal), out);
}

TEST_CASE("Coulomb friction takes friction times the normal change, and never reverses a slide") {
  const V normal{0, 1, 0}, still{0, 0, 0};
  check_equal(contact_velocity(Contact::separating, 0.5, V{2, -1, 0}, still, normal), {1.5, 0, 0});
  check_equal(contact_velocity(Contact::separating, 0.5, V{0.3, -1, 0.1}, still, normal), still);
  check_equal(contact_velocity(Contact::separating, 0.5, V{2, 1, 0}, still, normal), {2, 1, 0});
  // Seen from a moving wall it is the same.
  const V wall{0, 3, 4};
  check_equal(contact_velocity(Contact::separating, 0.5, V{2, 2, 4}, wall, normal), V{1.5, 3, 4});
}

TEST_CASE("a node without a way out sticks") {
  check_equal(contact_velocity(Contact::slip, 0.0, V{1, 2, 3}, V{4, 5, 6}, V{0, 0, 0}), {4, 5, 6});
}

TEST_CASE("a posed collider acts on the nodes inside it and on no others") {
  const Collider ground{"ground", std::make_shared<HalfSpace>(), Contact::sticky, 0, {}};
  const PosedCollider posed(ground, 0);
  std::array<Node<double, 3>, kBlockNodes<3>> nodes;
  for (auto& n : nodes) n = {V{1, -1, 0}, 1.0};
  nodes[0].m = 0;                                           // not in use
  BlockNodes<double, 3> block{nodes, {}, {0, -1, 0}, 0.1};  // y from -0.4 to -0.1
  posed.apply(block, 0.01);
  check_equal(nodes[0].v, {1, -1, 0});
  for (std::size_t n = 1; n < nodes.size(); ++n) check_equal(nodes[n].v, {0, 0, 0});

  for (auto& n : nodes) n = {V{1, -1, 0}, 1.0};
  block.block = {0, 0, 0};  // y from 0 to 0.3: only the first layer lies in it
  posed.apply(block, 0.01);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    check_equal(nodes[n].v, block.position(n).y() <= 0 ? V{0, 0, 0} : V{1, -1, 0});
}

TEST_CASE("a turned collider pushes along its turned normal") {
  RigidMotion turned({{0, Vec3::Zero(), Vec3(0, 0, std::numbers::pi / 2)}});  // solid where x > 0
  const Collider wall{"wall", std::make_shared<HalfSpace>(), Contact::separating, 0, turned};
  std::array<Node<double, 3>, kBlockNodes<3>> nodes;
  for (auto& n : nodes) n = {V{2, 1, 0}, 1.0};
  BlockNodes<double, 3> block{nodes, {}, {1, 0, 0}, 0.1};
  PosedCollider(wall, 0).apply(block, 0.01);
  for (const auto& n : nodes) check_equal(n.v, {0, 1, 0});
}

TEST_CASE("a collider that never moves does what it would do if it were looked at in every step") {
  RigidMotion turned({{0, Vec3(0.1, -0.05, 0), Vec3(0.3, 0.2, 0.5)}});
  REQUIRE(turned.still());
  const Collider wall{"wall", make_sphere(Vec3(0.2, 0.1, 0.3), 0.45), Contact::separating, 0.3, turned};
  std::vector<std::uint64_t> occupied;
  for (int x = -4; x < 8; x += 4)
    for (int y = -4; y < 8; y += 4) occupied.push_back(block_of_key(cell_key<3>({x, y, 2})));
  std::sort(occupied.begin(), occupied.end());
  const BlockLayout<3> layout(occupied);
  const double h = 0.1;
  StillCollider<double, 3> still(wall);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> speed(-1, 1);
  for (int round = 0; round < 2; ++round) {
    still.find(layout, h);
    std::size_t held = 0;
    for (std::size_t b = 0; b < layout.size(); ++b) {
      std::array<Node<double, 3>, kBlockNodes<3>> before, nodes, expected;
      for (auto& n : before)
        n = {V{speed(random), speed(random), speed(random)}, speed(random) < 0 ? 0.0 : 1.0};
      nodes = expected = before;
      BlockNodes<double, 3> block{nodes, {}, layout.coord(b), h, b};
      still.apply(block, 0.01);
      BlockNodes<double, 3> reference{expected, {}, layout.coord(b), h, b};
      PosedCollider(wall, 0).apply(reference, 0.01);
      for (std::size_t n = 0; n < nodes.size(); ++n)
        for (int d = 0; d < 3; ++d) {
          CHECK(nodes[n].v[d] == expected[n].v[d]);
          held += nodes[n].v[d] != before[n].v[d];
        }
    }
    CHECK(held > 100);
  }
  CHECK(still.bytes() > 0);
}

TEST_CASE("domain walls stop what leaves and let go of what returns") {
  const DomainWalls box{Vec3(0, 0, 0), Vec3(1, 1, 1), Contact::separating, 0};
  std::array<Node<double, 3>, kBlockNodes<3>> nodes;
  for (auto& n : nodes) n = {V{-1, 2, -3}, 1.0};
  BlockNodes<double, 3> block{nodes, {}, {-1, 0, 2}, 0.1};  // x < 0, y from 0, z from 0.8 to 1.1
  box.apply(block, 0.01);
  for (std::size_t n = 0; n < nodes.size(); ++n) check_equal(nodes[n].v, {0, 2, -3});
}

TEST_CASE("domain walls leave a 2D scene alone that does not reach them, whatever their depth") {
  const DomainWalls box{Vec3(0, 0, 0), Vec3(1, 1, 0), Contact::sticky, 0};
  std::array<Node<double, 2>, kBlockNodes<2>> nodes;
  for (auto& n : nodes) n = {{1.0, 1.0}, 1.0};
  BlockNodes<double, 2> block{nodes, {}, {1, 1}, 0.1};
  box.apply(block, 0.01);
  for (const auto& n : nodes) CHECK(n.v[0] == 1.0);
}
