// How much more may be wrong of trees that others hide.
#include "foliage/neighbours.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/random.h"

namespace manzana::foliage {
namespace {

/// 20 m high, 4 m to all sides, and lets half of the light through.
PreparedPlant tall_plant() {
  PreparedPlant plant;
  plant.height_m = 20;
  plant.crown_radius_m = 4;
  plant.cover_m2 = static_cast<float>(0.5 * std::numbers::pi * 4 * 10);
  return plant;
}

struct Wood {
  std::vector<PreparedPlant> plants{tall_plant()};
  PlantTable table = make_plant_table(plants);
  std::vector<TreeSite> sites;

  explicit Wood(std::span<const Vec2d> places) {
    for (const Vec2d& place : places) {
      sites.push_back(make_site(plants[0], 0, 20, 4, 0, sites.size()));
      sites.back().position = {static_cast<float>(place.x), static_cast<float>(place.y), 0};
    }
    see_neighbours(sites, plants, rows(Vec3d(0)));
  }
  static std::vector<Vec4> rows(const Vec3d& eye, double turn = 0) {
    const double c = std::cos(turn), s = std::sin(turn);
    return {{c, -s, 0, -eye.x}, {s, c, 0, -eye.y}, {0, 0, 1, -eye.z}};
  }
  /// Times as much as if it stood alone.
  double growth(std::uint32_t site, const Vec3d& eye) const {
    const std::vector<Vec4> block = rows(eye);
    TreesSeen seen{sites, block, {}, 1.0 / 900};
    const double heeded = static_cast<double>(error_of_tree(table, seen, site).error2);
    seen.heed_neighbours = false;
    return std::sqrt(heeded / static_cast<double>(error_of_tree(table, seen, site).error2));
  }
};

std::vector<Vec2d> scattered(int trees, double side, std::uint64_t seed) {
  support::Random random(seed);
  std::vector<Vec2d> places;
  for (int i = 0; i < trees; ++i) places.emplace_back(random.within(0, side), random.within(0, side));
  return places;
}

}  // namespace

TEST_CASE("neighbours: a tree that stands alone has no leeway from anywhere") {
  const std::vector<Vec2d> places{{0, 0}, {300, 0}};
  const Wood wood(places);
  for (const Vec3d& eye : {Vec3d(400, 1, 2), Vec3d(-9, 5, 30), Vec3d(0, 0, 500), Vec3d(0, 0, 11)})
    CHECK(wood.growth(0, eye) == 1);
}

TEST_CASE("neighbours: what hides a tree counts from its side alone and from above not at all") {
  const std::vector<Vec2d> places{{0, 0}, {12, 0}, {24, 0}, {36, 0}};
  const Wood wood(places);
  CHECK(wood.growth(0, {500, 0, 10}) == Approx(1 + leeway(1 - 0.125)).epsilon(0.02));  // three, each half
  CHECK(wood.growth(0, {-500, 0, 10}) == 1);
  CHECK(wood.growth(0, {0, 500, 10}) == 1);
  CHECK(wood.growth(0, {0, 0, 500}) == 1);
  CHECK(wood.growth(0, {500, 0, 510}) == Approx(1 + leeway(0.2)).epsilon(0.15));  // 8 m of 20, by one
  CHECK(wood.growth(3, {500, 0, 10}) == 1);
  CHECK(wood.growth(0, {20, 0, 10}) < 1 + leeway(0.5));  // past most of them
}

TEST_CASE("neighbours: leeway never shrinks an error and grows along a straight way out of the wood") {
  const auto places = scattered(400, 200, 5);
  const Wood wood(places);
  for (std::uint32_t site = 0; site < 40; ++site) {
    double before = 1;
    for (double far = 5; far < 400; far *= 1.3) {
      const double now = wood.growth(site, Vec3d(wood.sites[site].position) + Vec3d(0.6 * far, 0.8 * far, 10));
      CHECK(now >= before * (1 - 1e-5));
      before = now;
    }
  }
}

TEST_CASE("neighbours: no step of the eye changes an error at once") {
  const auto places = scattered(600, 150, 6);
  const Wood wood(places);
  for (std::uint32_t site = 0; site < 600; site += 37) {
    double before = 0;
    for (int step = 0; step <= 3600; ++step) {  // half a metre each, rising
      const double angle = step * std::numbers::pi / 1800;
      const double now = wood.growth(site, {300 * std::cos(angle), 300 * std::sin(angle), 0.03 * step});
      if (step > 0) CHECK(now == Approx(before).epsilon(0.05));
      before = now;
    }
  }
}

TEST_CASE("neighbours: the way that a block is turned makes no difference") {
  const auto places = scattered(300, 120, 7);
  const Wood wood(places);
  const double turn = std::numbers::pi / 2;
  Wood turned = wood;
  for (TreeSite& site : turned.sites) {
    const Vec3 p = site.position;
    const auto c = static_cast<float>(std::cos(turn)), s = static_cast<float>(std::sin(turn));
    site.position = {c * p.x + s * p.y, c * p.y - s * p.x, p.z};
  }
  see_neighbours(turned.sites, turned.plants, Wood::rows(Vec3d(0), turn));
  for (std::size_t i = 0; i < wood.sites.size(); ++i)
    for (std::uint32_t byte = 0; byte < 4 * glsl::kLeewayAzimuths; ++byte) {
      const std::uint32_t a = byte / 4, shift = 8 * (byte % 4);
      const std::uint32_t here = (turned.sites[i].leeway[a] >> shift) & 255U;
      const std::uint32_t there =
          (wood.sites[i].leeway[(a + glsl::kLeewayAzimuths / 4) % glsl::kLeewayAzimuths] >> shift) & 255U;
      CHECK(std::max(here, there) - std::min(here, there) <= 1);
    }
}

}  // namespace manzana::foliage
