// Sizes of few leaves: the crown covers what it did, from views that were not fitted as well.
#include "foliage/leaf_scale.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "foliage/cell_visibility.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/lod_factor.h"
#include "foliage/octahedral.h"
#include "foliage/prepare.h"
#include "foliage/raster.h"

namespace manzana::foliage {
namespace {

PreparedPlant grown(const char* species) {
  PreparedPlant plant = prepare(grow_plant(builtin_species(species), 3));
  plant.bark.clear();
  plant.branch_levels.clear();
  // Without area, to give all pictures one frame.
  for (const float end : {-1.0F, 1.0F}) {
    PlantQuad quad{};
    for (auto& corner : quad.corners) corner.position = Vec3(0, 0, plant.height_m / 2) + Vec3(end * 2 * plant.height_m);
    plant.bark.push_back(quad);
  }
  return plant;
}

PreparedPlant thinned(const PreparedPlant& full, double u, float scale) {
  PreparedPlant few = full;
  few.leaves.clear();
  few.cells.clear();
  for (std::uint32_t c = 0; c < full.cells.size(); ++c) {
    LeafCell cell = full.cells[c];
    const auto first = static_cast<std::uint32_t>(few.leaves.size());
    const auto count = static_cast<std::uint32_t>(kept(cell.quads.size(), u, cell_threshold(c)));
    for (std::uint32_t q = cell.quads.first; q < cell.quads.first + count; ++q) {
      few.leaves.push_back(full.leaves[q]);
      for (std::size_t k = 0; k < 4; ++k)
        few.leaves.back().corners[k].position = scaled_corner(full.leaves[q], k, scale);
    }
    few.cells.push_back({cell.centre, cell.axes, cell.half, {first, static_cast<std::uint32_t>(few.leaves.size())}});
  }
  return few;
}

constexpr int kPixels = 1024;

std::vector<Vec3d> directions() {
  std::vector<Vec3d> out;
  for (const std::uint32_t d : {1U, 5U, 6U, 7U, 11U, 13U}) out.push_back(grid_direction(5, d % 5, d / 5));
  return out;
}

double covered(const PreparedPlant& plant) {
  double sum = 0;
  for (const Vec3d& to_eye : directions()) {
    const CellPixels pixels = cell_pixels(plant, to_eye, kPixels);
    for (const std::uint32_t seen : pixels.seen) sum += seen;
  }
  return sum;
}

}  // namespace

TEST_CASE("few leaves at the fitted size cover what all did") {
  const PreparedPlant plant = grown("oak");
  REQUIRE(plant.leaves.size() > 1000);
  const LeafScaleFit fit = fit_leaf_scale(plant);
  CHECK(std::is_sorted(fit.scale.begin(), fit.scale.end()));
  CHECK(fit.scale[0] == 1);
  const double all = covered(plant);
  for (const std::size_t i : {1U, 2U, 4U, 6U}) {
    const double u = std::exp2(-0.5 * static_cast<double>(i));
    double mean = 0;
    for (const float r : fit.residual[i]) mean += static_cast<double>(r) / LeafScaleFit::kViews;
    CHECK(mean == Approx(0).margin(0.005));
    const double now = covered(thinned(plant, u, fit.scale[i])) / all,
                 by_area = covered(thinned(plant, u, static_cast<float>(1 / std::sqrt(u)))) / all,
                 unscaled = covered(thinned(plant, u, 1)) / all;
    INFO("u " << u << " scale " << fit.scale[i] << " fitted " << now << " by area " << by_area << " as they are "
              << unscaled);
    CHECK(now == Approx(1).margin(0.04));
    CHECK(by_area > now);
    CHECK(unscaled < now);
  }
}

TEST_CASE("every level of points covers what the leaves do") {
  PreparedPlant plant = grown("oak");
  const double wanted = covered(plant);
  REQUIRE(plant.point_levels.size() > 3);
  // The squares of a level as quads that turn to each of the views.
  for (std::size_t i = 0; i < plant.point_levels.size(); ++i) {
    double sum = 0;
    for (const Vec3d& to_eye : directions()) {
      const ParallelView view = view_of(plant, to_eye, kPixels);
      std::vector<bool> hits(std::size_t{kPixels} * kPixels);
      const Run points = plant.point_levels[i].points;
      for (std::uint32_t p = points.first; p < points.last; ++p) {
        const Vec2 c = view.pixel(plant.points[p].position);
        const float half = 0.5F * view.pixels_of(std::sqrt(plant.points[p].area));
        const auto set = [&](int x, int y, float, float) { hits[static_cast<std::size_t>(y * kPixels + x)] = true; };
        for (const float turn : {-1.0F, 1.0F})
          for_each_pixel({c + Vec2(-half), c + Vec2(half), c + Vec2(half, -half) * turn}, kPixels, set);
      }
      sum += static_cast<double>(std::count(hits.begin(), hits.end(), true));
    }
    INFO("level " << i << " of " << plant.point_levels[i].points.size());
    CHECK(sum / wanted == Approx(1).margin(i < 4 ? 0.06 : 0.2));  // fitted with the bark, which hides some of both
  }
}

TEST_CASE("leaf sizes between the fitted ones") {
  std::array<float, kLeafScales> scale{};
  for (std::size_t i = 0; i < kLeafScales; ++i) scale[i] = 1 + static_cast<float>(i);
  CHECK(leaf_scale_at(scale, 1) == 1);
  CHECK(leaf_scale_at(scale, 2) == 1);
  CHECK(leaf_scale_at(scale, std::numeric_limits<float>::quiet_NaN()) == 1);
  CHECK(leaf_scale_at(scale, 0.5F) == Approx(3));
  CHECK(leaf_scale_at(scale, std::exp2(-0.25F)) == Approx(1.5));
  CHECK(leaf_scale_at(scale, 1e-6F) == Approx(17));
  CHECK(leaf_scale_at(scale, 0) == Approx(17));
}

TEST_CASE("a plant without leaves has leaf sizes of one") {
  for (const float s : fit_leaf_scale(PreparedPlant{}).scale) CHECK(s == 1);
}

}  // namespace manzana::foliage
