// Points for leaves: what they hide, their order, and how they merge.
#include "foliage/leaf_points.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "foliage/leaf_cloud.h"
#include "foliage/random.h"

namespace manzana::foliage {
namespace {

/// Left half opaque and red, right half air.
Image half_image() {
  Image image{8, {}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (const int c : {200, 30, 30, x < 4 ? 255 : 0}) image.rgba.push_back(static_cast<std::uint8_t>(c));
  return image;
}

PlantQuad unit_quad() {
  PlantQuad quad{};
  const float x[]{0, 1, 1, 0}, y[]{0, 0, 1, 1};
  for (std::size_t k = 0; k < 4; ++k) {
    quad.corners[k] = {{x[k], y[k], 0}, pack_uv(x[k]), pack_uv(y[k])};
    quad.normals[k] = pack_normal({0, 0, 1}) | (2U << 30);
    quad.shades[k] = 255;
  }
  return quad;
}

double area(const PointCloud& cloud) {
  double sum = 0;
  for (const CloudPoint& p : cloud) sum += static_cast<double>(p.area);
  return sum;
}

PointCloud random_cloud(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  PointCloud cloud(count);
  for (CloudPoint& p : cloud) {
    p.position = {random.uniform(), random.uniform(), random.uniform()};
    p.area = 0.5F + random.uniform();
    p.normal = {random.spread(1), random.spread(1), random.spread(1)};
    p.colour = {random.uniform(), random.uniform(), random.uniform()};
    p.shade = random.uniform();
  }
  return cloud;
}

std::vector<Vec3> positions(const PointCloud& cloud) {
  std::vector<Vec3> out;
  for (const CloudPoint& p : cloud) out.push_back(p.position);
  return out;
}

bool is_permutation(std::vector<std::uint32_t> order, std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  std::sort(order.begin(), order.end());
  return order == all;
}

}  // namespace

TEST_CASE("four points of a card hide half of its leaf") {
  QuadPoints points(half_image());
  const auto four = points.four(unit_quad(), Organ::leaf);
  const PointCloud cloud(four.begin(), four.end());
  CHECK(area(cloud) == Approx(0.25).epsilon(1e-3));  // half of it is leaf, and half of that is seen
  for (const CloudPoint& p : four) {
    if (p.area < 1e-4F) continue;  // a packed uv of 1 is a little more
    CHECK(p.position.x < 0.51F);
    CHECK(packed(p).colour == 0x001e1ec8U);
    CHECK(p.level == 2);
    CHECK(p.shade == Approx(1));
  }
  // The middle of mass is that of the leaf.
  Vec3 middle(0);
  for (const CloudPoint& p : four) middle += p.position * (p.area / 0.25F);
  CHECK(middle.x == Approx(0.25).margin(1e-3));
  CHECK(middle.y == Approx(0.5).margin(1e-3));
}

TEST_CASE("a quad that is one triangle has four points of equal area") {
  QuadPoints points(Image{});
  PlantQuad quad = unit_quad();
  quad.corners[3] = quad.corners[2];
  for (const CloudPoint& p : points.four(quad, Organ::leaf)) CHECK(p.area == Approx(0.5 / 2 / 4));
}

TEST_CASE("leaf of nothing but air has points without area") {
  QuadPoints points(Image{1, {9, 9, 9, 0}});
  for (const CloudPoint& p : points.four(unit_quad(), Organ::leaf)) CHECK(p.area == 0);
  CHECK(points.many(unit_quad(), Organ::leaf, 100, 1).empty());
}

TEST_CASE("many points of a large leaf have its area") {
  QuadPoints points(half_image());
  const PointCloud many = points.many(unit_quad(), Organ::leaf, 200, 5);
  CHECK(many.size() > 80);
  CHECK(many.size() < 130);
  CHECK(area(many) == Approx(0.25).epsilon(1e-3));
  for (const CloudPoint& p : many) CHECK(p.position.x < 0.56F);
}

TEST_CASE("orders of points are permutations and the same each time") {
  for (const std::size_t count : {0U, 1U, 3U, 4U, 5U, 9U, 1000U, 4097U}) {
    const std::vector<Vec3> at = positions(random_cloud(count, count));
    CHECK(is_permutation(spatial_order(at), count));
    CHECK(is_permutation(progressive_order(at), count));
  }
  const std::vector<Vec3> same(1000, Vec3(1));
  CHECK(is_permutation(progressive_order(same), 1000));
}

TEST_CASE("every prefix of a progressive order is spread") {
  const std::vector<Vec3> at = positions(random_cloud(4096, 8));
  const std::vector<std::uint32_t> order = progressive_order(at);
  const auto octants = [&](std::size_t prefix) {
    std::array<double, 8> count{};
    for (std::size_t i = 0; i < prefix; ++i) {
      const Vec3& p = at[order[i]];
      count[(p.x > 0.5F ? 1U : 0U) + (p.y > 0.5F ? 2U : 0U) + (p.z > 0.5F ? 4U : 0U)] += 1;
    }
    return count;
  };
  const std::array<double, 8> all = octants(4096);
  for (const std::size_t prefix : {8U, 24U, 64U, 200U, 512U}) {
    const std::array<double, 8> some = octants(prefix);
    double squares = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const double off = some[k] - all[k] * static_cast<double>(prefix) / 4096;
      squares += off * off / 8;
    }
    const double variance_at_random = static_cast<double>(prefix) * (1.0 / 8) * (7.0 / 8);
    CHECK(squares <= 0.4 * variance_at_random);  // cuts at medians are not quite those at one half
  }
}

TEST_CASE("four points merge to one with their sum and means") {
  const PointCloud cloud = random_cloud(4, 2);
  const PointCloud one = merged(cloud, 100);
  REQUIRE(one.size() == 1);
  Vec3 position(0), colour(0);
  double shade = 0;
  for (const CloudPoint& p : cloud) {
    const auto share = static_cast<float>(static_cast<double>(p.area) / area(cloud));
    position += p.position * share;
    colour += p.colour * share;
    shade += static_cast<double>(p.shade * share);
  }
  CHECK(static_cast<double>(one[0].area) == Approx(area(cloud)));
  CHECK(glm::distance(one[0].position, position) < 1e-6F);
  CHECK(glm::distance(one[0].colour, colour) < 1e-6F);
  CHECK(static_cast<double>(one[0].shade) == Approx(shade));
}

TEST_CASE("merging keeps area and large points and drops what has none") {
  PointCloud cloud = random_cloud(1001, 4);
  cloud[7].area = 50;
  cloud[8].area = 0;
  const PointCloud coarse = merged(cloud, 10);
  CHECK(coarse.size() == 1 + 250);
  CHECK(area(coarse) == Approx(area(cloud)).epsilon(1e-6));
  CHECK(std::any_of(coarse.begin(), coarse.end(), [](const CloudPoint& p) { return p.area == 50; }));
  CHECK(merged({}, 1).empty());
}

TEST_CASE("flowers keep their points longer than leaves") {
  PointCloud cloud = random_cloud(4000, 6);
  for (std::size_t i = 0; i < 400; ++i) cloud[i].organ = Organ::flower;
  const std::vector<PointCloud> levels = merged_levels(cloud);
  const auto flowers = [](const PointCloud& level) {
    return std::count_if(level.begin(), level.end(), [](const CloudPoint& p) { return p.organ == Organ::flower; });
  };
  REQUIRE(levels.size() >= 3);
  CHECK(flowers(levels[0]) == 400);
  CHECK(levels[0].size() == 400 + 900);
  CHECK(flowers(levels[1]) == 100);
  CHECK(levels[1].size() == 100 + 225);
  CHECK(levels.back().size() <= 64);
  for (const PointCloud& level : levels) CHECK(area(level) == Approx(area(cloud)).epsilon(1e-5));
}

TEST_CASE("large leaves come first with points of their own") {
  Plant plant;
  const auto card = [&](float x, float size) {
    const auto first = static_cast<std::uint32_t>(plant.mesh.leaves.triangles());
    std::array<MeshVertex, 4> corners{};
    const float dx[]{0, 1, 1, 0}, dz[]{0, 0, 1, 1};
    for (std::size_t k = 0; k < 4; ++k)
      corners[k].position = {x + dx[k] * size, 0, 1 + dz[k] * size}, corners[k].normal = {0, 1, 0};
    add_quad(plant.mesh.leaves, corners);
    plant.terminals.push_back({{first, first + 2}, -1, Organ::leaf});
  };
  for (int i = 0; i < 300; ++i) card(0.2F * static_cast<float>(i % 30), 0.1F);
  card(7, 2);
  PreparedPlant ready;
  prepare_leaves(plant, {}, ready);
  check(ready);
  CHECK(ready.large_quads == 1);
  for (const PlantQuad::Corner& corner : ready.leaves[ready.shuffled[0]].corners) CHECK(corner.position.x >= 7);
  CHECK(ready.large_points > 500);
  CHECK(ready.point_levels[0].points.size() == ready.large_points + 4 * 300);
  float largest = 0;
  for (std::uint32_t i = 0; i < ready.large_points; ++i) largest = std::max(largest, ready.points[i].area);
  CHECK(largest < 0.01F);  // of 2 m2
}

TEST_CASE("points of unlike leaves have contrast and those of one colour have none") {
  CloudPoint dark, bright;
  dark.area = bright.area = 1;
  dark.colour = Vec3(0.1F), bright.colour = Vec3(0.3F);
  dark.square = 0.01F, bright.square = 0.09F;
  const PointCloud pair{dark, bright};
  const std::uint32_t contrast = packed(merged({dark, bright}, 10).front()).colour >> 24;
  CHECK(static_cast<int>(contrast) == Approx(127.5).margin(1));  // 0.1 off 0.2
  CHECK(packed(dark).colour >> 24 == 0);
}

}  // namespace manzana::foliage
