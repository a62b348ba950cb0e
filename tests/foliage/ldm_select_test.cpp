// Which sides and levels of a pack are shown from where, and how much of each.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "foliage/ldm_select.h"
#include "foliage/ldm_views.h"
#include "tests/foliage/ldm_samples.h"

namespace manzana::foliage {
namespace {

std::array<float, 64> weights_of_all(const LdmPack& pack, const Vec3& to_eye) {
  std::array<float, 64> all{};
  const LdmWeights weights = ldm_weights(pack, to_eye);
  for (std::size_t i = 0; i < 3; ++i) all[weights.side[i]] += weights.weight[i];
  return all;
}

const std::vector<LdmPack>& both_kinds() {
  static const std::vector<LdmPack> packs{pack_of_blobs({.sides = LdmSides::paper}),
                                          pack_of_blobs({.sides = LdmSides::octahedral})};
  return packs;
}
}  // namespace

TEST_CASE("view weights sum to one and none is negative") {
  support::Random random(3);
  for (const LdmPack& pack : both_kinds())
    for (int i = 0; i < 20000; ++i) {
      const Vec3 eye = i == 0 ? Vec3(0, 0, -1) : i == 1 ? Vec3(0, 0, 1) : random_direction(random);
      const LdmWeights weights = ldm_weights(pack, eye);
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(weights.weight[k] >= 0);
        CHECK(weights.side[k] < pack.sides.size());
        sum += static_cast<double>(weights.weight[k]);
      }
      CHECK(std::abs(sum - 1) <= 4 * 0x1p-24);
    }
}

TEST_CASE("a side seen from itself is shown most") {
  for (const LdmPack& pack : both_kinds())
    for (std::size_t i = 0; i < pack.sides.size(); ++i) {
      const auto weights = weights_of_all(pack, 3.0F * pack.sides[i].towards);
      CHECK(weights[i] == *std::max_element(weights.begin(), weights.end()));
      if (pack.options.sides == LdmSides::octahedral) CHECK(weights[i] > 0.999F);
    }
}

TEST_CASE("view weights change steadily") {
  support::Random random(4);
  for (const LdmPack& pack : both_kinds())
    for (int i = 0; i < 3000; ++i) {
      const Vec3 eye = random_direction(random);
      if (pack.options.sides == LdmSides::paper && eye.z < 0.05F) continue;  // below its sides the nearest is taken
      const auto before = weights_of_all(pack, eye),
                 after = weights_of_all(pack, glm::normalize(eye + 0.01F * random_direction(random)));
      for (std::size_t k = 0; k < before.size(); ++k) CHECK(std::abs(before[k] - after[k]) < 0.15F);
    }
}

TEST_CASE("ring weights run from one level to the next") {
  const LdmZone zone(10, 20);
  CHECK(zone.next(0) == 0);
  CHECK(zone.next(10) == 0);
  CHECK(zone.next(15) == Approx(0.5));
  CHECK(zone.next(20) == 1);
  CHECK(zone.next(1e9) == 1);
  CHECK(LdmZone(5, 5).next(4.999) == 0);
  CHECK(LdmZone(5, 5).next(5) == 1);
  CHECK_THROWS_AS(LdmZone(6, 5), std::invalid_argument);
  CHECK_THROWS_AS(LdmZone(std::nan(""), 5), std::invalid_argument);
  const LdmPack& pack = both_kinds()[1];
  CHECK(ldm_ring(pack, 0).level == 0);
  CHECK(ldm_ring(pack, 1e9).level == kLdmLevels - 1);
  for (double d = 1; d < 3000; d *= 1.01) {
    const LdmRing ring = ldm_ring(pack, d);
    CHECK(ring.level + (ring.next > 0 ? 1 : 0) < level_count(pack.options));
    // Never a level that is made for farther away.
    if (ring.level > 0) CHECK(pack.distance_of(ring.level) <= d);
    CHECK(ring.next < 1);
  }
}

TEST_CASE("shares of a tree follow each other from nought to one") {
  const auto& packs = both_kinds();
  const LdmTable table = make_ldm_table(packs);
  std::vector<TreeSite> sites(400);
  support::Random random(12);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    sites[i] = {};
    const auto size = static_cast<float>(random.within(0.3, 3));
    sites[i].position = 90.0F * random_direction(random);
    sites[i].radius = size, sites[i].height = 1.3F * size;
    sites[i].turn = {std::cos(static_cast<float>(i)), std::sin(static_cast<float>(i))};
    sites[i].plant = static_cast<std::uint32_t>(i % 2);
  }
  const std::array<Vec4, 3> rows{Vec4(1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, 0)};
  const Run run{0, 400};
  LdmSelection chosen;
  for (const bool sorted : {false, true}) {
    choose_ldm(table, {sites, rows, {&run, 1}, 500}, sorted, chosen);
    REQUIRE(chosen.trees.size() == 400);
    std::vector<float> reached(chosen.trees.size(), 0);
    std::vector<std::vector<LdmItem>> of_tree(chosen.trees.size());
    for (const LdmItem& item : chosen.items) of_tree[item.tree].push_back(item);
    for (auto& items : of_tree) {
      std::sort(items.begin(), items.end(), [](const LdmItem& a, const LdmItem& b) { return a.low < b.low; });
      REQUIRE_FALSE(items.empty());
      CHECK(items.size() <= 6);
      CHECK(items.front().low == 0);
      CHECK(items.back().high == 1);
      for (std::size_t i = 1; i < items.size(); ++i) CHECK(items[i].low == items[i - 1].high);
    }
    std::uint64_t drawn = 0;
    for (const glm::uvec2& group : chosen.groups)
      drawn += std::min(glsl::kLdmGroup, chosen.items[group.x].last - group.y);
    CHECK(drawn == chosen.mosaics);
    CHECK(chosen.ranks.back().last == chosen.groups.size());
  }
}

TEST_CASE("an eye in the middle of a tree and one infinitely far see nothing of it") {
  const auto& packs = both_kinds();
  const LdmTable table = make_ldm_table(packs);
  TreeSite site{};
  site.radius = site.height = 1;
  site.turn = {1, 0};
  const Run run{0, 1};
  LdmSelection chosen;
  for (const float away : {5.0F, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    const std::array<Vec4, 3> rows{Vec4(1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, 1, -away)};
    choose_ldm(table, {{&site, 1}, rows, {&run, 1}, 500}, false, chosen);
    CHECK(chosen.items.empty());
  }
}
}  // namespace manzana::foliage
