// Oriented boxes on the sets that break them (numerics.md 14), and the cells of a crown.
#include "foliage/obb_cells.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "foliage/random.h"
#include "point_sets.h"

namespace manzana::foliage {
namespace {

bool holds(const OrientedBox& box, const Vec3d& p) {
  for (int k = 0; k < 3; ++k) {
    long double along = 0;
    for (int i = 0; i < 3; ++i)
      along += (static_cast<long double>(p[i]) - static_cast<long double>(box.centre[i])) *
               static_cast<long double>(box.axes[k][i]);
    if (!(std::abs(along) <= static_cast<long double>(box.half[k]))) return false;
  }
  return true;
}

/// What every box must be.
void check_box(const OrientedBox& box, const Points& points) {
  CHECK(std::all_of(points.begin(), points.end(), [&](const Vec3d& p) { return holds(box, p); }));
  const Mat3d axes(box.axes);
  CHECK(glm::determinant(axes) == Approx(1).margin(1e-6));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) CHECK(glm::dot(axes[i], axes[k]) == Approx(i == k ? 1 : 0).margin(3e-7));
  Vec3d low = points[0], high = points[0];
  for (const Vec3d& p : points) low = glm::min(low, p), high = glm::max(high, p);
  // Half of the straight box: the padding, and the rounding of a centre in floats.
  const Vec3d largest = 0.5 * (high - low) + 16 * 0x1p-24 * glm::length(Vec3d(box.centre)) + 1.1e-6;
  CHECK(volume(box) <= 8 * largest.x * largest.y * largest.z * (1 + 1e-6));
}

}  // namespace

TEST_CASE("an oriented box holds flat and thin and small sets") {
  const Mat3d turn = some_turn();
  const Points sets[]{
      {{1, 2, 3}},
      {{1, 2, 3}, {1, 2, 3}},
      {{0, 0, 0}, {1, 1, 1}},
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
      random_points(100, {3, 0, 0}, turn, {0, 0, 5}, 1),
      random_points(100, {3, 2, 0}, turn, {0, 0, 5}, 2),
      random_points(100, {3, 2, 1e-9}, turn, {0, 0, 5}, 3),
      random_points(500, {1, .4, .04}, turn, {}, 4),
      random_points(500, {1, 1, 1}, turn, {}, 5),
      random_points(500, {1, .4, .04}, turn, {676000, 4.6e6, 200}, 6),
  };
  for (const Points& set : sets) check_box(fit_box(set), set);
}

TEST_CASE("the corners of turned squares and cubes have boxes no larger than straight ones") {
  for (const double height : {0.0, 1.0}) {
    Points corners;
    for (const double x : {0.0, 1.0})
      for (const double y : {0.0, 1.0})
        for (const double z : {0.0, height}) corners.push_back(some_turn() * Vec3d(x, y, z));
    check_box(fit_box(corners), corners);
  }
}

TEST_CASE("a box of what is not finite is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(fit_box(Points{}), std::invalid_argument);
  for (const double bad : {nan, inf, -inf, 1e200, -1e10})
    CHECK_THROWS_AS(fit_box(Points{{0, 0, 0}, {0, bad, 0}}), std::invalid_argument);
}

namespace {

/// Leaves of one to five quads, small, in a ball; or all in one place.
LeafQuads random_leaves(std::uint32_t count, float radius) {
  LeafQuads out;
  Random random(9);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(out.quads.size());
    const Vec3 place{random.spread(radius), random.spread(radius), random.spread(radius)};
    for (std::uint32_t q = 0; q < 1 + i % 5; ++q) {
      PlantQuad quad{};
      for (auto& corner : quad.corners) corner.position = place + Vec3(random.spread(.1F), random.spread(.1F), 0);
      out.quads.push_back(quad);
    }
    out.leaves.push_back({first, static_cast<std::uint32_t>(out.quads.size())});
  }
  return out;
}

}  // namespace

TEST_CASE("cells have few quads and every leaf once") {
  for (const float radius : {4.0F, 0.0F})
    for (const std::uint32_t most : {1U, 3U, 64U, 256U, 100'000U}) {
      const LeafQuads source = random_leaves(3000, radius);
      const auto cells = split_cells(source, most);
      std::vector<std::uint32_t> all;
      bool small = true;
      for (const auto& cell : cells) {
        std::uint32_t quads = 0;
        for (const std::uint32_t leaf : cell) quads += source.leaves[leaf].size();
        small = small && !cell.empty() && (quads <= most || cell.size() == 1);
        all.insert(all.end(), cell.begin(), cell.end());
      }
      CHECK(small);
      std::sort(all.begin(), all.end());
      REQUIRE(all.size() == 3000);
      CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
      CHECK(cells == split_cells(source, most));
    }
  CHECK(split_cells({}, 256).empty());
}

}  // namespace manzana::foliage
