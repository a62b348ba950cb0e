// What a prepared plant's leaves must be, on plants that are grown and plants that are read.
#include "foliage/leaf_cloud.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdio>

#include "foliage/generate.h"
#include "foliage/import/gltf_plant.h"
#include "foliage/import/species.h"
#include "foliage/leaf_quads.h"
#include "foliage/leaf_scale.h"
#include "foliage/prepare.h"
#include "tests/support/data.h"

namespace manzana::foliage {
namespace {

bool holds(const LeafCell& cell, const Vec3& p) {
  for (int k = 0; k < 3; ++k) {
    long double along = 0;
    for (int i = 0; i < 3; ++i)
      along += (static_cast<long double>(p[i]) - static_cast<long double>(cell.centre[i])) *
               static_cast<long double>(cell.axes[k][i]);
    if (!(std::abs(along) <= static_cast<long double>(cell.half[k]))) return false;
  }
  return true;
}

void check_cells(const PreparedPlant& ready, std::uint32_t most) {
  std::size_t outside = 0, large = 0;
  for (const LeafCell& cell : ready.cells) {
    large += cell.quads.size() > most ? 1 : 0;
    for (std::uint32_t q = cell.quads.first; q < cell.quads.last; ++q)
      for (const PlantQuad::Corner& corner : ready.leaves[q].corners) outside += holds(cell, corner.position) ? 0 : 1;
  }
  CHECK(outside == 0);
  CHECK(large == 0);
}

void check_points(const PreparedPlant& ready) {
  REQUIRE(!ready.point_levels.empty());
  const double all = static_cast<double>(ready.leaf_area_m2);
  for (std::size_t i = 0; i < ready.point_levels.size(); ++i) {
    const PointLevel& level = ready.point_levels[i];
    CHECK(static_cast<double>(level.area) > all / 2 / 8.01);
    CHECK(static_cast<double>(level.area) < all / 2 * 8.01);
    double sum = 0;
    for (std::uint32_t p = level.points.first; p < level.points.last; ++p)
      sum += static_cast<double>(ready.points[p].area);
    CHECK(sum == Approx(static_cast<double>(level.area)).epsilon(1e-4));
    if (i > 0) CHECK(level.points.size() <= ready.point_levels[i - 1].points.size() * 0.6 + 64);
  }
}

}  // namespace

TEST_CASE("leaves of a grown plant are in cells and in points") {
  PrepareOptions options;
  options.quads_per_cell = 64;
  const Plant plant = grow_plant(builtin_species("shrub"), 3);
  PreparedPlant ready;
  prepare_leaves(plant, options, ready);
  check_cells(ready, 64);
  check_points(ready);
  CHECK(ready.leaves.size() == leaf_quads(plant).quads.size());
  CHECK(std::is_sorted(ready.leaf_scale.begin(), ready.leaf_scale.end()));
  CHECK(ready.leaf_scale[0] == 1);
  PreparedPlant again;
  prepare_leaves(plant, options, again);
  CHECK(again.shuffled == ready.shuffled);
  CHECK(again.leaf_scale == ready.leaf_scale);
}

TEST_CASE("a plant without leaves has none") {
  PreparedPlant ready;
  prepare_leaves(Plant{}, {}, ready);
  CHECK(ready.leaves.empty());
  CHECK(ready.cells.empty());
  CHECK(ready.point_levels.empty());
}

TEST_CASE("leaves of real trees are in cells and in points") {
  for (const char* name : {"oak_medium", "pine_medium", "aspen_medium_modelled"}) {
    INFO(name);
    const auto file = data_file("trees/" + std::string(name) + ".glb");
    if (!file) return;
    PreparedPlant ready;
    prepare_leaves(read_plant(*file), {}, ready);
    check_cells(ready, 256);
    check_points(ready);
  }
}

// The table of the report: run by its name.
TEST_CASE("figures of leaf sizes", "[.figures]") {
  std::printf("plant, quads, cells, s(u) at u = 2^(-i/2), worst view's error of coverage\n");
  for (const char* name : {"ash_medium", "aspen_medium_modelled", "oak_dense", "oak_medium", "pine_medium"}) {
    const auto file = data_file("trees/" + std::string(name) + ".glb");
    if (!file) return;
    const Plant plant = read_plant(*file);
    const auto start = std::chrono::steady_clock::now();
    const PreparedPlant ready = prepare(plant);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const LeafScaleFit fit = fit_leaf_scale(ready);
    std::printf("%s: %zu quads, %zu cells, %zu points, %zu levels, %zu large, %zu lines, area %.1f, %.2f s\n", name,
                ready.leaves.size(), ready.cells.size(), ready.points.size(), ready.point_levels.size(),
                std::size_t{ready.large_quads}, ready.lines.size(), static_cast<double>(ready.leaf_area_m2), seconds);
    for (const PointLevel& level : ready.point_levels)
      std::printf("  level of %u points: area by %.2f\n", level.points.size(),
                  static_cast<double>(2 * level.area / ready.leaf_area_m2));
    for (std::size_t i = 0; i < kLeafScales; ++i) {
      std::printf("  u %.4f s %.3f:", std::exp2(-0.5 * static_cast<double>(i)), static_cast<double>(fit.scale[i]));
      for (const float r : fit.residual[i]) std::printf(" %+.1f", static_cast<double>(100 * r));
      std::printf(" %%\n");
    }
  }
}

}  // namespace manzana::foliage
