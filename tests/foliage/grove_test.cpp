// Trees of a block as one cloud of points: what any first few of them are, against the trees themselves.
#include "foliage/grove.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>

#include "foliage/branch_points.h"
#include "foliage/generate.h"
#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "foliage/leaf_scale.h"
#include "foliage/prepare.h"
#include "foliage/select.h"

namespace manzana::foliage {
namespace {

const std::vector<PreparedPlant>& plants() {
  static const std::vector<PreparedPlant> all = [] {
    std::vector<PreparedPlant> made;
    for (const char* name : {"oak", "conifer"})
      made.push_back(prepare(grow_plant(builtin_species(name), 3), {.visibility_side = 0}));
    for (const char* file : {MANZANA_PLANTS "/grass.json", MANZANA_PLANTS "/herb.json"})
      made.push_back(load_or_prepare({file}, {}, {.visibility_side = 0}, {}));
    return made;
  }();
  return all;
}

constexpr std::uint32_t kOak = 0, kGrass = 2, kHerb = 3;

/// Far from each other, of their natural proportions; `kinds` of them by turns.
std::vector<TreeSite> make_sites(std::uint32_t n, std::uint32_t kinds, std::uint32_t first = kOak) {
  std::vector<TreeSite> sites;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t kind = first + i % kinds;
    const PreparedPlant& plant = plants()[kind];
    const float size = 0.5F + 0.01F * static_cast<float>(i % 7);
    sites.push_back(
        make_site(plant, kind, size * plant.height_m, size * plant.crown_radius_m, static_cast<float>(i), i));
    sites.back().position = {1000.0F * static_cast<float>(i), 0, 0};
  }
  return sites;
}

/// Square metres that the points cover as squares that face the eye: each tree for itself.
double covered(const Grove& grove, const GroveShown& shown, double up, double pixel_m) {
  const double level = std::sqrt(1 - up * up);
  std::map<std::uint32_t, std::map<std::pair<int, int>, bool>> pictures;
  for (std::uint32_t r = 0; r < shown.count; ++r) {
    const LeafPoint& point = grove.points[r];
    const double weight = std::clamp(static_cast<double>((shown.edge - static_cast<float>(r)) / shown.fade), 0.0, 1.0);
    const double half = 0.5 * std::sqrt(static_cast<double>(point.area * shown.scale) * weight) / pixel_m;
    const Vec3d p(point.position);
    const double x = p.x / pixel_m, y = (-up * p.y + level * p.z) / pixel_m;
    auto& picture = pictures[point.tree];
    for (int j = static_cast<int>(std::ceil(y - half)); j < y + half; ++j)
      for (int i = static_cast<int>(std::ceil(x - half)); i < x + half; ++i) picture[{i, j}] = true;
  }
  std::size_t pixels = 0;
  for (const auto& [tree, picture] : pictures) pixels += picture.size();
  return static_cast<double>(pixels) * pixel_m * pixel_m;
}

}  // namespace

TEST_CASE("grove: every first few of its points have of each tree its share to a point") {
  const std::vector<TreeSite> sites = make_sites(20, 2);
  const Grove grove = make_grove(plants(), sites);
  std::map<std::uint32_t, int> all, now;
  for (const LeafPoint& point : grove.points) ++all[point.tree];
  REQUIRE(all.size() == sites.size());
  REQUIRE(grove.points.size() == grove.rule.points);
  for (std::size_t n = 1; n <= grove.points.size(); ++n) {
    ++now[grove.points[n - 1].tree];
    for (const auto& [tree, count] : all) {
      const double share = static_cast<double>(n) * count / static_cast<double>(grove.points.size());
      REQUIRE(std::abs(now[tree] - share) < 2);
    }
  }
}

TEST_CASE("grove: fewer of its points have the mean place and colour of all") {
  const std::vector<TreeSite> sites = make_sites(200, 1);
  const Grove grove = make_grove(plants(), sites);
  const auto mean = [&](std::size_t n) {
    Vec4d sum(0);
    double area = 0;
    for (const LeafPoint& point : std::span(grove.points).first(n)) {
      const auto a = static_cast<double>(point.area);
      sum += a * Vec4d(point.position.z, point.colour & 255U, point.colour >> 8 & 255U, point.colour >> 16 & 255U);
      area += a;
    }
    return sum / area;
  };
  const Vec4d all = mean(grove.points.size());
  for (const std::size_t part : {2U, 8U, 32U}) {
    CAPTURE(part);
    const Vec4d some = mean(grove.points.size() / part);
    for (int i = 0; i < 4; ++i) CHECK(some[i] == Approx(all[i]).epsilon(0.05));
  }
}

TEST_CASE("grove: however few of its points are shown they cover what its trees do from everywhere") {
  const std::uint32_t kind = GENERATE(kOak, kGrass);
  const std::vector<TreeSite> sites = make_sites(60, 1, kind);
  const Grove grove = make_grove(plants(), sites);
  const double unit = static_cast<double>(plants()[kind].height_m / plants()[kOak].height_m);
  for (const double up : {0.0, 0.5, 1.0}) {
    const double rise = up < 1 ? up / std::sqrt(1 - up * up) : 10;
    double trees = 0;
    for (const TreeSite& site : sites)
      trees += static_cast<double>(covered_m2(plants()[kind], rise) * site.radius * site.radius);
    for (const double error_m : {unit, 2 * unit, 4 * unit}) {
      const GroveShown shown = shown_of(grove.rule, {error_m, up, 1, {}}, grove.rule.points);
      CAPTURE(kind, up, error_m, shown.count, grove.rule.points);
      CHECK(covered(grove, shown, up, 0.05 * unit) == Approx(trees).epsilon(0.05));
    }
  }
}

TEST_CASE("grove: for each square of the error it shows as many points as it is made for and covers the same") {
  const std::vector<TreeSite> sites = make_sites(60, 1);
  constexpr double kError = 2, kBeyond = 1.15;  // with those that fade
  double trees = 0;
  for (const TreeSite& site : sites)
    trees += static_cast<double>(covered_m2(plants()[kOak], 0) * site.radius * site.radius);
  for (const double points : {0.35, 0.7, 1.4}) {
    const Grove grove = make_grove(plants(), sites, 0, {.points = points});
    const GroveShown shown = shown_of(grove.rule, {kError, 0, 1, {}}, grove.rule.points);
    const double squares = static_cast<double>(grove.rule.cover_m2 * grove.rule.cover[0]) / (kError * kError);
    CAPTURE(points, squares);
    CHECK(shown.count == Approx(kBeyond * points * squares).margin(1));
    CHECK(covered(grove, shown, 0, 0.05) == Approx(trees).epsilon(0.05));
  }
  const auto all = [&](double height) { return grove_rule(plants(), sites, {.all = height, .points = 0.1}).points; };
  CHECK(all(20) == Approx(4 * all(10)).epsilon(0.05));  // where it takes over trees cover four times as many squares
}

TEST_CASE("grove: a level is the first part of all and is the same each time") {
  const std::vector<TreeSite> sites = make_sites(12, 2);
  const Grove all = make_grove(plants(), sites), again = make_grove(plants(), sites),
              part = make_grove(plants(), sites, 2);
  const auto same = [](const Grove& a, const Grove& b, std::size_t n) {
    return std::memcmp(a.points.data(), b.points.data(), n * sizeof(LeafPoint)) == 0;
  };
  REQUIRE(again.points.size() == all.points.size());
  CHECK(same(all, again, all.points.size()));
  CHECK(part.points.size() == points_at(all.rule.points, 2));
  CHECK(same(all, part, part.points.size()));
  CHECK(part.rule.points == all.rule.points);
}

TEST_CASE("grove: no point is wider than another, nor than the rule has it, however unlike its plants are") {
  constexpr double kWidest = 1.75;  // errors: 1 / sqrt(GroveOptions::points), more where points hide each other
  std::vector<TreeSite> herbs = make_sites(40, 1, kHerb), mixed = make_sites(120, 1, kGrass), wood = make_sites(30, 2);
  mixed.insert(mixed.end(), herbs.begin(), herbs.end());
  for (const std::vector<TreeSite>& sites : {herbs, mixed, wood}) {
    const Grove grove = make_grove(plants(), sites);
    double highest = 0;
    for (const TreeSite& site : sites)
      highest = std::max(highest, static_cast<double>(plants()[site.plant].height_m * site.height));
    for (const double up : {0.0, 0.7, 1.0})
      for (double height = GroveOptions{}.none(); height > 0.5; height *= 0.6) {
        const double error_m = highest / height;
        const GroveShown shown = shown_of(grove.rule, {error_m, up, 1, {}}, grove.rule.points);
        double widest = 0, sum = 0;
        for (std::uint32_t i = 0; i < shown.count; ++i) {
          const double width = std::sqrt(static_cast<double>(grove.points[i].area * shown.scale)) / error_m;
          widest = std::max(widest, width), sum += width;
        }
        CAPTURE(up, height, shown.count);
        CHECK(widest < 1.25 * sum / shown.count);
        CHECK(widest < kWidest);
      }
  }
}

TEST_CASE("grove: a stretched ball and a stretched disc cover what geometry says") {
  for (const auto& [r, h] : {std::pair{1.0, 1.0}, {0.5, 2.0}, {3.0, 0.7}})
    for (std::size_t view = 0; view < kGroveViews; ++view) {
      TreeSite site{};
      site.radius = static_cast<float>(r), site.height = static_cast<float>(h);
      const NaturalView seen = natural_view(site, view);
      const double e = glm::radians(30.0 * static_cast<double>(view)), natural = glm::radians(30.0 * seen.view);
      CAPTURE(r, h, view);
      CHECK(seen.scale == Approx(r * std::hypot(h * std::cos(e), r * std::sin(e))));
      CHECK(seen.scale * std::sin(natural) == Approx(r * r * std::sin(e)).margin(1e-6));
    }
}

TEST_CASE("grove: from a level are as many points as any view asks for that takes it") {
  const GroveRule rule = make_grove(plants(), make_sites(12, 2)).rule;
  for (double error_m = 0.1; error_m < 1e4; error_m *= 1.3) {
    const GroveSight sight{error_m, 0.3, 1, {}};
    const std::uint32_t there = points_at(rule.points, level_of(rule, sight));
    CAPTURE(error_m, there);
    CHECK(shown_of(rule, sight, there).count == shown_of(rule, sight, rule.points).count);
    CHECK(std::isfinite(shown_of(rule, sight, there).scale));
  }
}

TEST_CASE("grove: trees that are far higher than most of a block have a grove of their own") {
  std::vector<TreeSite> sites = make_sites(21, 1, kGrass);
  const std::vector<TreeSite> oaks = make_sites(4, 1);
  sites.insert(sites.begin() + 7, oaks.begin(), oaks.end());
  CHECK(grove_rows(plants(), sites, true) == std::vector<std::uint32_t>{7, 8, 9, 10});
  CHECK(grove_rows(plants(), sites, false).size() == 21);
  CHECK(grove_rows(plants(), oaks, true).empty());
  CHECK(grove_rows(plants(), {}, false).empty());
}

TEST_CASE("grove: points of bare branches lie on them and share their area") {
  const PreparedPlant& grass = plants()[kGrass];
  REQUIRE(grass.leaves.empty());
  const std::vector<LeafPoint> points = branch_points(grass, 256);
  REQUIRE(points.size() == 256);
  double area = 0, of_lines = 0;
  for (const LineSegment& line : grass.lines)
    of_lines += static_cast<double>((line.radius_a + line.radius_b) * glm::distance(line.a, line.b));
  float farthest = 0;
  for (const LeafPoint& point : points) {
    area += static_cast<double>(point.area);
    float nearest = 1e9F;
    for (const LineSegment& line : grass.lines) {
      const Vec3 along = line.b - line.a;
      const float t = std::clamp(glm::dot(point.position - line.a, along) / glm::dot(along, along), 0.0F, 1.0F);
      nearest = std::min(nearest, glm::distance(point.position, line.a + t * along));
    }
    farthest = std::max(farthest, nearest);
  }
  CHECK(farthest < 1e-5F);
  CHECK(area == Approx(0.785398 * of_lines).epsilon(1e-4));
  CHECK(branch_points(PreparedPlant(), 8).empty());
}

TEST_CASE("grove: plants of nothing and blocks without trees are no points") {
  const std::vector<PreparedPlant> bare(1);
  CHECK(make_grove(bare, {}).points.empty());
  TreeSite site{};
  site.radius = site.height = 1;
  const Grove grove = make_grove(bare, {&site, 1});
  CHECK(grove.points.empty());
  CHECK(shown_of(grove.rule, {1, 0, 1, {}}, 0).count == 0);
}

}  // namespace manzana::foliage
