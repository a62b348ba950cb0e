#include "foliage/farthest_pair.h"

#include <catch2/catch.hpp>
#include <vector>

#include "foliage/random.h"

namespace manzana::foliage {
namespace {

double distance2(const Vec3& a, const Vec3& b) {
  const Vec3d d = Vec3d(a) - Vec3d(b);
  return glm::dot(d, d);
}

PointPair by_definition(const std::vector<Vec3>& points) {
  PointPair best{0, 1};
  double most = distance2(points[0], points[1]);
  for (std::uint32_t i = 0; i < points.size(); ++i)
    for (std::uint32_t j = i + 1; j < points.size(); ++j)
      if (distance2(points[i], points[j]) > most) most = distance2(points[i], points[j]), best = {i, j};
  return best;
}

std::vector<Vec3> cloud(Random& random, std::size_t size, const Vec3& extent) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < size; ++i)
    points.push_back(Vec3(random.spread(1), random.spread(1), random.spread(1)) * extent);
  return points;
}

}  // namespace

TEST_CASE("the farthest pair is that of all pairs") {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    const Vec3 extent(round % 3 == 0 ? 0 : 1, round % 5 == 0 ? 0 : 1, static_cast<float>(1 + round % 7));
    const auto points = cloud(random, 2 + random.bits() % 200, extent);
    CHECK(farthest_pair(points) == by_definition(points));
  }
  const auto most = cloud(random, 2000, Vec3(1));
  CHECK(farthest_pair(most) == by_definition(most));
  const auto tube = cloud(random, 6000, Vec3(0.1F, 0.1F, 2));
  CHECK(farthest_pair(tube) == by_definition(tube));
}

TEST_CASE("of equally far pairs the first is taken and points without extent are a pair") {
  std::vector<Vec3> ring;
  for (const float x : {-1.0F, 1.0F})
    for (const float y : {-1.0F, 1.0F}) ring.push_back({x, y, 0});
  CHECK(farthest_pair(ring) == PointPair{0, 3});
  CHECK(farthest_pair(std::vector<Vec3>(5, Vec3(1, 2, 3))) == PointPair{0, 1});
  CHECK(!farthest_pair({}));
  CHECK(!farthest_pair(std::vector<Vec3>(1)));
}

TEST_CASE("a large ball of points gives nearly its diameter and soon") {
  Random random(2);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> ball;
    while (ball.size() < 3000) {
      const Vec3 p(random.spread(1), random.spread(1), random.spread(1));
      if (glm::length(p) > 0.5F) ball.push_back(glm::normalize(p));
    }
    const PointPair exact = by_definition(ball), found = *farthest_pair(ball);
    CHECK(distance2(ball[found.a], ball[found.b]) >= 0.95 * 0.95 * distance2(ball[exact.a], ball[exact.b]));
  }
}

}  // namespace manzana::foliage
