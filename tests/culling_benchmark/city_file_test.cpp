#include "apps/culling_benchmark/city_file.h"

#include "apps/culling_benchmark/truth.h"
#include "scenegraph/import/import.h"
#include "tests/support/temporary_folder.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

namespace {

bool holds(const culling::BoxD& a, const culling::BoxD& b) {
  return glm::all(glm::lessThanEqual(a.min, b.min)) && glm::all(glm::greaterThanEqual(a.max, b.max));
}

}  // namespace

TEST_CASE("city file: every object of every layer, in blocks that hold them and their half-streets") {
  const Imported town = import_city("builtin:town", {.seed = 1}, [](std::string_view, double) {});
  const Scene& scene = town.scene;
  const baselines::City city = city_of(scene, 1);
  CHECK(city.objects() == scene.buildings.table.size() + scene.surfaces.table.size() + scene.trees.table.size());
  REQUIRE(city.blocks.size() == scene.blocks.size());
  REQUIRE(city.first.size() == city.blocks.size() + 1);
  CHECK(city.kinds.size() == city.objects());
  REQUIRE(city.triangles.size() == city.objects());
  std::size_t outside = 0, flat = 0;
  for (std::uint32_t b = 0; b < city.blocks.size(); ++b) {
    for (std::uint32_t i = city.first[b]; i < city.first[b + 1]; ++i) {
      outside += holds(city.blocks[b].box, city.boxes[i]) ? 0 : 1;
      flat += city.triangles[i] == 0 ? 1 : 0;
    }
    for (std::uint32_t h = scene.traffic.block_first[b]; h < scene.traffic.block_first[b + 1]; ++h)
      outside += holds(city.blocks[b].box, half_street_bounds(scene.traffic, scene.traffic.block_halves[h])) ? 0 : 1;
  }
  CHECK(outside == 0);
  CHECK(flat == 0);
}

TEST_CASE("city file: no structure misses an object of the town") {
  Cities cities;
  const Workload work = make_workload("builtin:town", 1, 12, cities);
  const Truth truth = find_truth(work);
  for (const baselines::PeerInfo& info : baselines::peers()) {
    if (!info.available) continue;
    const auto peer = info.make(*work.city);
    const Counts counts = sum(check(*peer, work, truth));
    CAPTURE(info.slug);
    CHECK(counts.exact > 100);
    CHECK(counts.missed == 0);
    CHECK(counts.accepted >= counts.exact);
  }
}

TEST_CASE("city file: what cannot be read says which file") {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "bad.osm";
  Cities cities;
  std::ofstream(file) << "no city";
  CHECK_THROWS_WITH(cities.get(file, 1), Catch::Contains("bad.osm: "));
  CHECK_THROWS_WITH(look_up_case("nowhere"), Catch::Contains("nowhere: no such case"));
}
