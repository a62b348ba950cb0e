// What each law shows of a plant, from near to far.
#include "foliage/detail.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/budget.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/point_rule.h"
#include "foliage/prepare.h"

namespace manzana::foliage {
namespace {

const std::vector<PreparedPlant>& plants() {
  static const std::vector<PreparedPlant> all = [] {
    std::vector<PreparedPlant> grown;
    for (const char* name : {"broadleaf", "conifer", "birch"})
      grown.push_back(prepare(grow_plant(builtin_species(name), 3), {.visibility_side = 0}));
    return grown;
  }();
  return all;
}

std::span<const Detail> rows_of(const std::vector<Detail>& details, std::size_t plant) {
  return std::span(details).subspan(plant * glsl::kDetailSteps, glsl::kDetailSteps);
}

double error_of(std::size_t row) {
  return std::sqrt(std::ldexp(1 + 0.25 * static_cast<double>(row % 4), static_cast<int>(row / 4) - 32));
}

float cost_of(const CostTable& costs, std::size_t row) { return costs.vertices[row].x + costs.vertices[row].y; }

}  // namespace

TEST_CASE("laws have names") {
  for (const Law law : all_laws()) CHECK(law_named(name_of(law)) == law);
  CHECK_THROWS_WITH(law_named("ourselves"), Catch::Contains("ours, gumbau, gumbau-ramp, deussen, gadbem"));
}

TEST_CASE("every law shows sound numbers and all of a plant from near and less from far") {
  const Law law = GENERATE(from_range(all_laws().begin(), all_laws().end()));
  INFO(name_of(law));
  PlantTable table = make_plant_table(plants());
  table.details = make_details(plants(), law);
  const CostTable costs = make_costs(table);
  for (std::size_t i = 0; i < plants().size(); ++i) {
    const auto rows = rows_of(table.details, i);
    for (const Detail& d : rows) {
      for (const float v : {d.share, d.to_points, d.lines}) REQUIRE((v >= 0 && v <= 1));
      REQUIRE((d.fade == -1 || (d.fade >= 0 && d.fade <= 1)));
      for (const float v : {d.scale, d.points, d.point_level, d.point_gain, d.bark, d.line_level})
        REQUIRE((v >= 0 && v < 1e9F));
    }
    CHECK(rows.front().to_points == 0);
    CHECK(rows.front().share == 1);
    CHECK(rows.front().bark == 0);
    const float near = cost_of(costs, i * glsl::kDetailSteps), far = cost_of(costs, (i + 1) * glsl::kDetailSteps - 1);
    CHECK(far <= near);
    if (law == Law::ours) CHECK(far < 0.002F * near);
  }
}

TEST_CASE("ours costs less the more may be wrong") {
  PlantTable table = make_plant_table(plants());
  table.details = make_details(plants(), Law::ours);
  const CostTable costs = make_costs(table);
  for (std::size_t i = 0; i < plants().size(); ++i)
    for (std::size_t row = i * glsl::kDetailSteps; row + 1 < (i + 1) * glsl::kDetailSteps; ++row) {
      INFO(i << " row " << row);
      CHECK(cost_of(costs, row + 1) <= cost_of(costs, row) * 1.03F);
    }
}

TEST_CASE("however few points are shown on average they cover what their level does") {
  PlantTable table = make_plant_table(plants());
  table.details = make_details(plants(), Law::ours);
  const std::vector<Vec4> rows{{1, 0, 0, 0}, {0, 1, 0, 1000}, {0, 0, 1, 0}};
  for (std::size_t i = 0; i < plants().size(); ++i) {
    const PreparedPlant& plant = plants()[i];
    constexpr std::uint64_t kTrees = 40'000;
    std::vector<TreeSite> sites;
    for (std::uint64_t id = 0; id < kTrees; ++id) {
      sites.push_back(make_site(plant, static_cast<std::uint32_t>(i), plant.height_m, plant.crown_radius_m, 0, id));
      sites.back().inv_scale2 = 1;
    }
    const std::vector<Run> all{{0, static_cast<std::uint32_t>(kTrees)}};
    for (const double wanted : {0.02, 0.3, 1.0, 3.0}) {
      const double error_m = std::sqrt(2.6 * static_cast<double>(plant.cover_m2) / wanted);
      Selection chosen;
      select(table, {sites, rows, all, error_m / 1000}, chosen);
      double area = 0;
      for (const Item& item : chosen.items)
        for (std::uint32_t rank = 0; item.kind == glsl::kPoints && rank < item.count; ++rank)
          area += static_cast<double>(plant.points[item.first - table.plants[i].first_point + rank].area * item.scale *
                                      std::clamp((item.edge - static_cast<float>(rank)) / item.fade, 0.0F, 1.0F));
      INFO(plant.name << ", " << wanted << " points");
      CHECK(area / static_cast<double>(kTrees) == Approx(plant.point_levels.back().area).epsilon(0.1));
    }
  }
}

TEST_CASE("deussen draws the vertices that its rule asks for") {
  const auto details = make_details(plants(), Law::points_and_lines);
  for (std::size_t i = 0; i < plants().size(); ++i) {
    const auto triangles = static_cast<double>(2 * plants()[i].leaves.size());
    const PointRule rule{.spacing_px = 1, .near_m = 1e-9};
    for (std::size_t row = 0; row < glsl::kDetailSteps; ++row) {
      const Detail& d = rows_of(details, i)[row];
      const double p = points_wanted(static_cast<double>(plants()[i].leaf_area_m2), error_of(row), 1, rule);
      const double shown = 3 * triangles * (1 - static_cast<double>(d.to_points)) +
                           static_cast<double>(d.points) * static_cast<double>(d.to_points);
      INFO(i << " row " << row << " p " << p);
      CHECK(shown == Approx(std::min(p, 3 * triangles)).epsilon(1e-4).margin(1e-3));
    }
  }
}

TEST_CASE("gadbem has levels and nothing between them") {
  for (const Detail& d : make_details(plants(), Law::levels)) {
    CHECK(d.bark == std::floor(d.bark));
    CHECK((d.to_points == 0 || d.to_points == 1));
    CHECK(d.lines == 1);
  }
}

TEST_CASE("a plant without leaves and one without branches have details") {
  Plant bare = grow_plant(builtin_species("shrub"), 2);
  bare.mesh.leaves = {};
  bare.terminals.clear();
  Plant leaves = grow_plant(builtin_species("shrub"), 2);
  leaves.mesh.bark = {};
  leaves.branches.clear();
  leaves.centre_lines.clear();
  for (Terminal& terminal : leaves.terminals) terminal.branch = -1;
  for (const Plant& plant : {bare, leaves}) {
    const std::vector<PreparedPlant> one{prepare(plant, {.visibility_side = 0})};
    for (const Law law : all_laws())
      for (const Detail& d : make_details(one, law))
        for (const float v : {d.share, d.scale, d.to_points, d.points, d.point_gain, d.bark, d.line_level})
          REQUIRE(std::isfinite(v));
  }
}

}  // namespace manzana::foliage
