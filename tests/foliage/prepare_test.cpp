#include "foliage/prepare.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "foliage/generate.h"
#include "foliage/import/species.h"

namespace manzana::foliage {

TEST_CASE("a grown plant is prepared with all its parts") {
  const Plant plant = grow_plant(builtin_species("broadleaf"), 5);
  std::vector<double> progress;
  PrepareOptions options;
  options.progress = [&](double done) { progress.push_back(done); };
  const PreparedPlant ready = prepare(plant, options);
  CHECK(ready.name == plant.name);
  CHECK(ready.height_m == measure(plant.mesh).height);
  CHECK(ready.crown_radius_m == measure(plant.mesh).radius);
  CHECK(ready.leaf_image.size == plant.leaf_image.size);
  CHECK(!ready.branch_levels.empty());
  CHECK(!ready.lines.empty());
  CHECK(!ready.cells.empty());
  CHECK(!ready.points.empty());
  REQUIRE(!progress.empty());
  CHECK(progress.back() == 1);
  CHECK(std::is_sorted(progress.begin(), progress.end()));
  CHECK(progress.front() == 0);
  for (std::size_t i = 1; i < progress.size(); ++i) CHECK(progress[i] - progress[i - 1] <= 0.1);
}

TEST_CASE("a plant that breaks a rule is not prepared") {
  Plant plant = grow_plant(builtin_species("broadleaf"), 5);
  plant.terminals.pop_back();
  CHECK_THROWS_AS(prepare(plant), std::invalid_argument);
}

TEST_CASE("a plant without anything is prepared to nothing") {
  const PreparedPlant ready = prepare(Plant{});
  CHECK(ready.bark.empty());
  CHECK(ready.lines.empty());
  CHECK(ready.leaves.empty());
}

}  // namespace manzana::foliage
