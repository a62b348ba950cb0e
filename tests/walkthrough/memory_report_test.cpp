#include "apps/walkthrough/memory_report.h"

#include <catch2/catch.hpp>

#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

TEST_CASE("memory report: needed is what was in sight and over_model what is held beside") {
  const Imported city = import_city("builtin:town", {}, {});
  const Scene& scene = city.scene;
  std::vector<foliage::PreparedPlant> plants(kPlantSpecies);
  for (foliage::PreparedPlant& plant : plants) plant.leaves.resize(10);
  PathNeeds needs(scene);
  VisibleSets sets(scene);
  const draw::DeviceMemory device{.meshes = 10'000'000, .plants = 1'000'000, .lists = 500};
  const MemoryReport none = report_memory(scene, plants, needs, device);
  CHECK(none.device[0].needed == 0);
  CHECK(none.device[1].needed == 0);
  find_visible(scene, culling::View{}, Structure::none, sets);
  needs.see(sets);
  const MemoryReport all = report_memory(scene, plants, needs, device);
  CHECK(*all.device[0].needed == Approx(all.host[0].held).epsilon(0.01));
  CHECK(all.device[1].needed > 0);
  CHECK(over_model(all.host) < 6);  // all meshes, not all species
  CHECK(over_model(all.device) == Approx((10e6 + 1e6) / (*all.device[0].needed + *all.device[1].needed)));
  CHECK(to_text(all).find("over_model: device ") != std::string::npos);
}

}  // namespace manzana::walkthrough
