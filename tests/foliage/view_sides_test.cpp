#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/detail.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "foliage/random.h"
#include "foliage/wind.h"

namespace manzana::foliage {
namespace {

float within(Random& random, float low, float high) { return low + (high - low) * random.uniform(); }

const std::vector<PreparedPlant>& plants() {
  static const std::vector<PreparedPlant> made{prepare(grow_plant(builtin_species("oak"), 3)),
                                               prepare(grow_plant(builtin_species("palm"), 4))};
  return made;
}

struct Stand {
  PlantTable table;
  std::vector<TreeSite> sites;
  std::vector<Vec4> rows;
  std::vector<Run> runs;

  Stand(std::uint64_t seed, const Vec3d& eye) {
    table = make_plant_table(plants());
    table.details = make_details(plants(), Law::ours);
    Random random(seed);
    for (std::uint32_t i = 0; i < 200; ++i) {
      TreeSite& site = sites.emplace_back(make_site(plants()[i % 2], i % 2, within(random, 3, 25), within(random, 1, 9),
                                                    random.spread(3), hash(seed, i)));
      site.position = {random.spread(60), random.spread(60), 0};
    }
    rows = {{1, 0, 0, -eye.x}, {0, 1, 0, -eye.y}, {0, 0, 1, -eye.z}};
    runs = {{0, 200}};
  }
};

/// How far inside, at most, any corner of a quad may come, as it is drawn: scaled about its anchor, in the wind.
double most_inside(const Stand& stand, const TreeRecord& tree, const PlantQuad& quad, float scale, const Vec4& side) {
  const auto at = [&](const Vec3& p) {
    const Vec4d q(Vec3d(p), 1);
    return Vec3d(glm::dot(Vec4d(tree.row_x), q), glm::dot(Vec4d(tree.row_y), q), glm::dot(Vec4d(tree.row_z), q));
  };
  const TreeSite& site = stand.sites[tree.site];
  double most = -1e9;
  for (const PlantQuad::Corner& corner : quad.corners) {
    const Vec3d p = at(quad.anchor + (corner.position - quad.anchor) * scale);
    most = std::max(most, glm::dot(Vec3d(side), p) + static_cast<double>(side.w));
  }
  return most + kMostSway * static_cast<double>(plants()[tree.plant].height_m * site.height);
}

bool beside(const Stand& stand, const TreeRecord& tree, const PlantQuad& quad, float scale, const ViewSides& sides) {
  return std::any_of(sides.begin(), sides.end(),
                     [&](const Vec4& side) { return most_inside(stand, tree, quad, scale, side) < 0; });
}

}  // namespace

TEST_CASE("cells that are left out are beside the picture with all of their leaves and the others are as ever") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  Random random(seed);
  const Vec3d eye(random.spread(50), random.spread(50), within(random, 1, 40)),
      forward(random.spread(1), random.spread(1), random.spread(.7F));
  const double fovy = glm::radians(static_cast<double>(within(random, 5, 120)));
  const double error = GENERATE(0.0005, 0.01, 0.05);
  const Stand stand(seed, eye);
  TreesSeen seen{stand.sites, stand.rows, stand.runs, error};
  Selection all, some;
  select(stand.table, seen, all);
  seen.sides = sides_of(culling::make_frustum(culling::look(eye, forward, {0, 0, 1}, fovy, 1.6)), eye);
  select(stand.table, seen, some);
  INFO("seed " << seed << " error " << error);
  REQUIRE(all.items.size() == some.items.size());
  std::uint64_t left_out = 0;
  for (std::size_t i = 0; i < all.items.size(); ++i) {
    const Item &a = all.items[i], &b = some.items[i];
    if (a.kind != glsl::kLeaves || a.count == b.count)
      REQUIRE((a.kind == b.kind && a.count == b.count && (a.count == 0 || (a.first == b.first && a.scale == b.scale))));
    if (a.count == b.count) continue;
    REQUIRE(b.count == 0);
    left_out += a.count;
    const TreeRecord& tree = all.trees[a.record];
    const PreparedPlant& plant = plants()[tree.plant];
    const std::uint32_t first =
        a.first - stand.table.plants[tree.plant].first_quad - static_cast<std::uint32_t>(plant.bark.size());
    for (std::uint32_t q = first; q < first + a.count; ++q)
      REQUIRE(beside(stand, tree, plant.leaves[q], a.scale, seen.sides));
  }
  const std::uint64_t leaves = count_shown(all).leaves;
  CHECK(left_out * 10 > leaves);  // the eye is among them, so many are beside
}

TEST_CASE("sides are where the frustum's are from another eye too") {
  const Vec3d eye(7, -3, 12), other(-100, 40, 3);
  const culling::FrustumD frustum = culling::make_frustum(culling::look(eye, {1, 2, -.3}, {0, 0, 1}, 1, 1.5));
  const ViewSides sides = sides_of(frustum, other);
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vec3d p(random.spread(200), random.spread(200), random.spread(50));
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const double exact = glm::dot(frustum.planes[k].normal, p - eye) + frustum.planes[k].offset;
      CHECK(glm::dot(Vec3d(sides[k]), p - other) + static_cast<double>(sides[k].w) == Approx(exact).margin(1e-3));
    }
  }
}

}  // namespace manzana::foliage
