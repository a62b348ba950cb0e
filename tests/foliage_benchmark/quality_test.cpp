// The names of --quality against a small grid of ways: by counts and pictures, so the same on every machine.
#include <catch2/catch.hpp>

#include "apps/foliage_benchmark/trade.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::foliage_benchmark {
namespace {

std::vector<foliage::PreparedPlant> two_plants() {
  std::vector<foliage::PreparedPlant> plants;
  for (const char* species : {"broadleaf", "conifer"}) {
    plants.push_back(prepare(grow_plant(foliage::builtin_species(species), 1), {.visibility_side = 0}));
    plants.back().name = species;
  }
  return plants;
}

/// Each quality, a little truer and a little less so; and the sources' laws.
std::vector<Setting> grid_of(std::span<const draw::Quality> qualities) {
  std::vector<Setting> grid;
  for (const draw::Quality& quality : qualities)
    for (const double times : {0.7, 1.0, 1.4}) grid.push_back({quality.tree_law, times * quality.tree_error_px});
  for (const foliage::Law law :
       {foliage::Law::prune, foliage::Law::ramp, foliage::Law::points_and_lines, foliage::Law::levels})
    for (const double error_px : {1.0, 2.0}) grid.push_back({law, error_px});
  return grid;
}

}  // namespace

TEST_CASE("quality: nothing on a small grid costs less and errs less than what its names stand for") {
  const gl::HeadlessContext context;
  std::vector<draw::Quality> qualities;
  for (const std::string& name : draw::quality_names())
    if (name != "exact") qualities.push_back(draw::quality_named(name));
  REQUIRE(qualities.size() == 3);
  const ErrorPlan plan{.heights = {64, 16}, .views = 4, .settings = grid_of(qualities), .product = false};
  const auto points = trade_points(measure_errors(two_plants(), plan, [](double) {}), {}, {});
  std::size_t beaten = 0;
  for (const TradePoint& p : points) {
    if (p.plant != kAllPlants || p.law == "full") continue;
    beaten += p.front.empty() ? 1 : 0;
    for (const draw::Quality& quality : qualities) {
      if (p.law != name_of(quality.tree_law) || p.error_px != quality.tree_error_px) continue;
      CAPTURE(quality.name, p.height_px, p.primitives);
      CHECK(p.front == "front");
    }
  }
  CHECK(beaten > 0);  // of the sources' laws some
}

}  // namespace manzana::foliage_benchmark
