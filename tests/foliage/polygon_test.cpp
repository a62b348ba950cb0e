#include "foliage/import/polygon.h"

#include <cmath>

#include "tests/support/random.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {

double area(const std::vector<Vec3d>& corners, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0;
  for (const auto& [a, b, c] : triangles)
    sum += 0.5 * glm::length(glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
  return sum;
}

/// A star about the origin in the plane across (1, 2, 3): every corner is seen from the middle.
std::vector<Vec3d> star(support::Random& random, int corners) {
  const Vec3d n = glm::normalize(Vec3d(1, 2, 3)), x = glm::normalize(glm::cross(n, Vec3d(1, 0, 0))),
              y = glm::cross(n, x);
  std::vector<Vec3d> out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners, radius = random.within(0.2, 2);
    out.push_back(x * (radius * std::cos(angle)) + y * (radius * std::sin(angle)));
  }
  return out;
}

}  // namespace

TEST_CASE("polygons: triangles cover a star exactly, turning as it does") {
  support::Random random(7);
  for (int round = 0; round < 300; ++round) {
    const auto corners = star(random, 4 + random.below(40));
    const auto triangles = triangulated(corners);
    const Vec3d total = area_vector(corners);
    REQUIRE(triangles.size() + 2 == corners.size());
    CHECK(area(corners, triangles) == Approx(0.5 * glm::length(total)).epsilon(1e-9));
    for (const auto& [a, b, c] : triangles)
      CHECK(glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), total) > -1e-9);
  }
}

TEST_CASE("polygons: what is degenerate still gives corners less two triangles") {
  using Corners = std::vector<Vec3d>;
  CHECK(triangulated(Corners{}).empty());
  CHECK(triangulated(Corners{{0, 0, 0}, {1, 0, 0}}).empty());
  CHECK(triangulated(Corners(5, {1, 1, 1})).size() == 3);
  CHECK(triangulated(Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).size() == 2);
  CHECK(triangulated(Corners{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 2);  // crosses itself
  CHECK(triangulated(Corners(1000, {0, 0, 0})).size() == 998);
}

TEST_CASE("polygons: a dart keeps its notch") {
  const std::vector<Vec3d> dart{{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}};
  CHECK(area(dart, triangulated(dart)) == Approx(1));
  const std::vector<Vec3d> shifted{dart[1], dart[2], dart[3], dart[0]};
  CHECK(area(shifted, triangulated(shifted)) == Approx(1));
}
