// From leaf quads to the last points a tree covers what all its leaves do.
#include "foliage/point_fit.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/detail.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "foliage/silhouettes.h"

namespace manzana::foliage {
namespace {

/// Trees that were not fitted.
std::vector<TreeSite> eight_others(const PreparedPlant& plant) {
  std::vector<TreeSite> sites;
  for (std::uint64_t id = 100; id < 100 + Silhouettes::kViews; ++id) {
    sites.push_back(make_site(plant, 0, plant.height_m, plant.crown_radius_m, 0, id));
    sites.back().inv_scale2 = 1;
  }
  return sites;
}

}  // namespace

TEST_CASE("at every distance a tree of our law covers what all its leaves do") {
  const std::string species = GENERATE(as<std::string>(), "poplar", "pine", "oak", "palm", "apple");
  const std::vector<PreparedPlant> plants{prepare(grow_plant(builtin_species(species), 3), {.visibility_side = 0})};
  const PreparedPlant& plant = plants[0];
  PlantTable table = make_plant_table(plants);
  table.details = make_details(plants, Law::ours);
  const std::vector<TreeSite> sites = eight_others(plant);
  const Silhouettes pictures(plant, std::array{0.0, 0.2, 0.7});
  const double all = covered(pictures.coverage(1, 1));
  const std::vector<Run> runs{{0, Silhouettes::kViews}};
  const std::vector<Vec4> rows{{1, 0, 0, 0}, {0, 1, 0, 1000}, {0, 0, 1, -table.plants[0].middle}};
  double sum = 0, squares = 0;
  int distances = 0;
  for (double pixels = 64; pixels >= 8; pixels *= 0.9, ++distances) {
    Selection chosen;
    select(table, {sites, rows, runs, static_cast<double>(plant.height_m) / pixels / 1000}, chosen);
    const double off = covered(pictures.coverage(chosen)) / all - 1;
    INFO(species << ", " << pixels << " px high");
    CHECK(std::abs(off) < 0.08);
    sum += off, squares += off * off;
  }
  INFO(species << ": " << sum / distances << " +- " << std::sqrt(squares / distances));
  CHECK(std::abs(sum / distances) < 0.01);
  CHECK(std::sqrt(squares / distances) < 0.025);
}

}  // namespace manzana::foliage
