// The claims of culling/lattice.h, one by one, against exact arithmetic.
#include "culling/lattice.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>

#include "culling/baselines/random.h"
#include "culling/pack.h"
#include "culling/planes.h"

namespace manzana::culling::test {
namespace {

using baselines::Random;
using Real = long double;
using Vec3l = glm::vec<3, Real>;

/// Of any size and place, up to 2e37 m as of a tree that is 1e37 m wide; one in four flat or a point.
BoxD any_box(Random& random) {
  const auto size = [&] { return random.chance(0.25) ? 0 : random.scale(1e-12, 1e37); };
  const double scale = random.chance(0.5) ? 1 : random.scale(1e-37, 1);  // one large size would hide all others
  const Vec3d half = Vec3d{size(), size(), size()} * scale;
  const Vec3d middle = random.chance(0.2) ? Vec3d(0) : random.direction() * random.scale(1e-9, 1e37);
  return {middle - half, middle + half};
}

TEST_CASE("a lattice holds its box, is exact in float, and is the finest") {
  Random random(21);
  for (int i = 0; i < 200'000; ++i) {
    const BoxD box = any_box(random);
    const Lattice l = make_lattice(box);
    INFO("seed 21, box " << i);
    int exponent = 0;
    REQUIRE(std::frexp(l.step, &exponent) == 0.5);
    REQUIRE(static_cast<double>(static_cast<float>(l.step)) == l.step);
    REQUIRE(Vec3d(Vec3(l.corner)) == l.corner);
    const Vec3l corner(l.corner), far = corner + static_cast<Real>(kLatticeEnd) * static_cast<Real>(l.step);
    REQUIRE(Vec3l(l.far_corner()) == far);
    const Real h = static_cast<Real>(l.step);
    for (int k = 0; k < 3; ++k) {
      REQUIRE(corner[k] <= static_cast<Real>(box.min[k]));
      REQUIRE(far[k] >= static_cast<Real>(box.max[k]) + h / 2);  // so that centres may be rounded upward
    }
    const Vec3d size = box.max - box.min, end = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double half_step = l.step / 2;
    REQUIRE((l.step == 0x1p-20 || std::max({size.x, size.y, size.z}) > half_step * (kLatticeEnd - 2) * (1 - 1e-15) ||
             std::max({end.x, end.y, end.z}) * 0x1p-23 > half_step));
  }
}

TEST_CASE("reaches are rounded up, by less than a step") {
  Random random(22);
  constexpr Real kRounded = 0x1p-36L;  // steps; of a double as long as the lattice
  for (int i = 0; i < 200'000; ++i) {
    const BoxD box = any_box(random);
    const Lattice l = make_lattice(box);
    const Reaches r = reaches_of(box, l.corner, l.far_corner(), 1 / l.step);
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const Real h = static_cast<Real>(l.step);
      const Real a = (static_cast<Real>(box.max[k]) - static_cast<Real>(l.corner[k])) / h;
      const Real b = (static_cast<Real>(l.far_corner()[k]) - static_cast<Real>(box.min[k])) / h;
      REQUIRE(r[axis] >= a - kRounded);
      REQUIRE(r[axis] < a + 1 + kRounded);
      REQUIRE(r[axis + 3] >= b - kRounded);
      REQUIRE(r[axis + 3] < b + 1 + kRounded);
    }
  }
  const Reaches beyond = reaches_of({Vec3d(-9e9), Vec3d(9e9)}, Vec3d(0), Vec3d(65535), 1);
  for (const std::uint16_t r : beyond) CHECK(r == 65535);
}

TEST_CASE("a ball on the lattice holds the ball") {
  Random random(23);
  Real most = 0;
  for (int i = 0; i < 200'000; ++i) {
    const BoxD box = any_box(random);
    const Lattice l = make_lattice(box);
    const Vec3d u{random.unit(), random.unit(), random.unit()};
    const Vec3d middle = box.min + u * (box.max - box.min);
    const SphereD ball{middle, random.chance(0.1) ? 0 : l.step * random.scale(1e-3, 1.1e5)};
    BqrNode node = empty_node(l);
    set_volumes(node, 3, box, ball);
    if (node.sphere[3][3] == 65535) continue;  // never outside, never inside
    const SphereD held = lane_sphere(node, 3);
    const Real spare = static_cast<Real>(held.radius) - static_cast<Real>(ball.radius) -
                       glm::length(Vec3l(held.center) - Vec3l(ball.center));
    REQUIRE(spare >= 0);
    most = std::max(most, spare / static_cast<Real>(l.step));
  }
  std::cout << "a ball is enlarged by up to " << most << " steps\n";
  CHECK(most < 0.9 + 65536 / 37800.0);
}

/// Unit, of any kind: along an axis or nearly, along a diagonal, anywhere.
Vec3d any_normal(Random& random) {
  const auto sign = [&] { return random.chance(0.5) ? 1.0 : -1.0; };
  const auto tiny = [&] { return random.chance(0.3) ? 0.0 : sign() * random.scale(1e-320, 1e-3); };
  switch (random.below(4)) {
    case 0: {
      Vec3d n{tiny(), tiny(), tiny()};
      n[static_cast<int>(random.below(3))] = sign();
      return glm::normalize(n);
    }
    case 1:
      return glm::normalize(Vec3d{sign() + tiny(), sign() + tiny(), sign() + tiny()});
    case 2:
      return glm::normalize(Vec3d{sign() + tiny(), sign() + tiny(), -0.0});
    default:
      return random.direction();
  }
}

std::uint16_t any_distance(Random& random) {
  switch (random.below(4)) {
    case 0:
      return static_cast<std::uint16_t>(random.below(4));
    case 1:
      return static_cast<std::uint16_t>(65535 - random.below(4));
    default:
      return static_cast<std::uint16_t>(random.below(65536));
  }
}

TEST_CASE("three floors: F is less than 3 off, and fits into 16 bits") {
  Random random(24);
  BqrTree tree;
  tree.reach = 1;
  Real least = 0, most = 0;
  std::uint32_t largest = 0;
  for (int i = 0; i < 3'000'000; ++i) {
    FrustumD f;
    f.count = 1;
    f.planes[0] = {any_normal(random), 0};
    const Planes planes = make_planes(tree, f);
    REQUIRE(planes.used == 1);
    std::uint32_t sum = 0;
    Real exact = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint16_t w = any_distance(random);
      sum += std::uint32_t{lattice_factor(f.planes[0].normal[static_cast<int>(k)])} * w >> 16;
      exact += static_cast<Real>(std::abs(f.planes[0].normal[static_cast<int>(k)])) * w;
    }
    const Real off = static_cast<Real>(sum) - exact * static_cast<Real>(kTestScale) / 65536;
    least = std::min(least, off);
    most = std::max(most, off);
    largest = std::max(largest, sum);
  }
  std::cout << "F is off by " << least << " to " << most << ", and at most " << largest << '\n';
  CHECK(least > -3);
  CHECK(least < -2);  // the extremes were asked for
  CHECK(most < 3);
  CHECK(most > 2);
  CHECK(largest < 65536);
  CHECK(largest > 65000);
}

TEST_CASE("the lattices of blocks are as fine as the largest block allows") {
  Random random(25);
  for (int trial = 0; trial < 2000; ++trial) {
    const Lattice l{Vec3d(0), 1};
    BqrNode node = empty_node(l);
    double largest = 1;
    for (std::uint32_t i = 0; i < kLanes; ++i) {
      const double size = std::floor(random.scale(1, 65536)) - 1;
      const Vec3d low = glm::floor(Vec3d{random.unit(), random.unit(), random.unit()} * (kLatticeEnd - size));
      set_volumes(node, i, {low, low + size * Vec3d{random.unit(), 1, random.unit()}}, {low, 0});
      if (random.chance(0.3)) continue;
      node.blocks |= static_cast<std::uint16_t>(1U << i);
      largest = std::max(largest, size);
    }
    const double fine = std::ldexp(largest, finest_shift(node));
    CHECK(fine <= kLatticeEnd);
    CHECK((fine * 2 > kLatticeEnd || finest_shift(node) == 15));
  }
  CHECK(finest_shift(BqrNode{}) == 15);
}

}  // namespace
}  // namespace manzana::culling::test
