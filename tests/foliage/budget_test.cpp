#include "foliage/budget.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/detail.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"

namespace manzana::foliage {
namespace {

struct Grove {
  std::vector<PreparedPlant> plants;
  PlantTable table;
  CostTable costs;
  std::vector<TreeSite> sites;

  Grove() {
    for (const char* name : {"broadleaf", "conifer", "shrub"})
      plants.push_back(prepare(grow_plant(builtin_species(name), 3)));
    table = make_plant_table(plants);
    table.details = make_details(plants, Law::ours);
    costs = make_costs(table);
    for (std::uint32_t i = 0; i < 4000; ++i) {  // in sectors of equal angle, ever farther
      const std::uint32_t kind = i % 3;
      TreeSite& site = sites.emplace_back(make_site(plants[kind], kind, 4 + static_cast<float>(i % 17), 3, 0, i));
      const float angle = 2.4F * static_cast<float>(i), far = 5 + 0.2F * static_cast<float>(i);
      site.position = {far * std::cos(angle), far * std::sin(angle), 0};
    }
  }
};

double vertices(const Selection& chosen) {
  const Shown shown = count_shown(chosen);
  return 4 * static_cast<double>(shown.bark + shown.leaves + shown.lines) + static_cast<double>(shown.points);
}

}  // namespace

TEST_CASE("vertices stay within a tenth of the budget whatever part of the trees is in view") {
  Grove grove;
  const std::vector<Vec4> rows{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -1.7F}};
  const double budget = GENERATE(60'000, 200'000, 600'000);
  for (std::uint32_t turn = 0; turn <= 90; turn += 6) {
    std::vector<Run> runs;
    for (std::uint32_t i = 0; i < grove.sites.size(); ++i) {
      const TreeSite& site = grove.sites[i];
      const float degrees = glm::degrees(std::atan2(site.position.y, site.position.x)) - static_cast<float>(turn);
      if (std::abs(degrees) < 30) runs.push_back({i, i + 1});
    }
    TreesSeen seen{grove.sites, rows, runs, 0.05 / 900};
    seen.error_at_1m = error_for(grove.costs, grove.table, seen, {.vertices = budget, .most_error = 1e4});
    Selection chosen;
    select(grove.table, seen, chosen);
    INFO("budget " << budget << " turn " << turn << " error px " << seen.error_at_1m * 900);
    CHECK(vertices(chosen) == Approx(budget).epsilon(0.1));
  }
}

TEST_CASE("without need or limit the error stays as asked") {
  Grove grove;
  const std::vector<Vec4> rows{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -1.7F}};
  const std::vector<Run> runs{{100, 120}};
  const TreesSeen seen{grove.sites, rows, runs, 1.0 / 900};
  CHECK(error_for(grove.costs, grove.table, seen, {}) == seen.error_at_1m);
  CHECK(error_for(grove.costs, grove.table, seen, {.vertices = 1e9}) == seen.error_at_1m);
  CHECK(error_for(grove.costs, grove.table, seen, {.vertices = 1, .most_error = 8}) == Approx(8.0 / 900));
}

}  // namespace manzana::foliage
