#include "foliage/point_shade.h"

#include <catch2/catch.hpp>
#include <span>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"

namespace manzana::foliage {
namespace {

/// Over the level's area.
double mean_shade(const PreparedPlant& plant, const PointLevel& level) {
  double sum = 0, area = 0;
  for (std::uint32_t p = level.points.first; p < level.points.last; ++p) {
    sum += static_cast<double>(plant.points[p].area * plant.points[p].shade);
    area += static_cast<double>(plant.points[p].area);
  }
  return sum / area;
}

}  // namespace

TEST_CASE("merged points are lighter than the mean of what they stand for since the outer leaves are seen") {
  for (const char* name : {"broadleaf", "oak"}) {
    INFO(name);
    const PreparedPlant plant = prepare(grow_plant(builtin_species(name), 2));
    const double finest = mean_shade(plant, plant.point_levels.front());
    CHECK(mean_shade(plant, plant.point_levels.back()) > 1.05 * finest);
    for (const LeafPoint& point : plant.points) REQUIRE((point.shade >= 0 && point.shade <= 1.5F));
  }
}

TEST_CASE("points of leaves that all have one light keep it") {
  PreparedPlant plant = prepare(grow_plant(builtin_species("shrub"), 2));
  for (PlantQuad& quad : plant.leaves) quad.shades = {102, 102, 102, 102};
  plant.leaf_image = {};
  for (LeafPoint& point : plant.points) point.shade = 0.25F, point.colour = 0x00ffffff;
  fit_point_shades(plant);
  const std::span of_leaves =
      std::span(plant.points).first(plant.point_levels.back().points.last);  // the grove's follow
  for (const LeafPoint& point : of_leaves) REQUIRE(point.shade == Approx(0.4).epsilon(0.01));
}

}  // namespace manzana::foliage
