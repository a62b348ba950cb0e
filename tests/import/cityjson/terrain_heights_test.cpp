#include <catch2/catch.hpp>

#include "scenegraph/import/terrain_heights.h"
#include "tests/support/random.h"

using namespace manzana;

TEST_CASE("heights of a wavy terrain are those of its triangles") {
  support::Random random(5);
  const auto height = [](double x, double y) { return 300 + 0.1 * x - 0.05 * y; };
  std::vector<TerrainHeights::Triangle> triangles;
  for (double x = -500; x < 500; x += 50)
    for (double y = -500; y < 500; y += 50) {
      const auto p = [&](double dx, double dy) { return Vec3d(x + dx, y + dy, height(x + dx, y + dy)); };
      triangles.push_back({p(0, 0), p(50, 0), p(50, 50)});
      triangles.push_back({p(0, 0), p(0, 50), p(50, 50)});  // wound the other way: as good
    }
  const TerrainHeights terrain(triangles);
  for (int i = 0; i < 1000; ++i) {
    const Vec2d p(random.within(-499, 499), random.within(-499, 499));
    REQUIRE(terrain.at(p));
    CHECK(*terrain.at(p) == Approx(height(p.x, p.y)).margin(1e-6));
  }
  CHECK_FALSE(terrain.at({501, 0}));
  CHECK_FALSE(terrain.at({1e300, 0}));
  CHECK_FALSE(TerrainHeights().at({0, 0}));
}

TEST_CASE("upright and endless triangles hold nothing and one long one is found") {
  const double far = std::numeric_limits<double>::infinity();
  const TerrainHeights terrain({{Vec3d(0, 0, 0), Vec3d(1, 0, 9), Vec3d(2, 0, 0)},
                                {Vec3d(0, 0, 0), Vec3d(far, 0, 9), Vec3d(2, far, 0)},
                                {Vec3d(0, 0, 7), Vec3d(1e5, 0, 7), Vec3d(0, 1, 7)},
                                {Vec3d(0, 0, 5), Vec3d(1, 0, 5), Vec3d(0, 1, 5)}});
  CHECK(terrain.at({5e4, 0.2}) == 7.0);
  CHECK(terrain.at({0.2, 0.2}) == 7.0);
}
