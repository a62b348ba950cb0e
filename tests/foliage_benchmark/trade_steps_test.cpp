// How much ways of drawing pop as the camera comes nearer.
#include "apps/foliage_benchmark/trade_steps.h"

#include <catch2/catch.hpp>

#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "tests/support/temporary_folder.h"

namespace manzana::foliage_benchmark {

TEST_CASE("steps: all detail pops nowhere, levels more than what fades, and what is known is not drawn again") {
  const gl::HeadlessContext context;
  const TemporaryFolder folder;
  const std::vector<foliage::PreparedPlant> plants{
      prepare(grow_plant(foliage::builtin_species("shrub"), 1), {.visibility_side = 0})};
  Stage stage(plants, sites_of(plants));
  const std::vector<Approached> shrub{{"shrub", extent_of(plants[0]), {0, 1}, 48}};
  const std::vector<Setting> settings{
      {foliage::Law::full}, {foliage::Law::ours, 0.25}, {foliage::Law::ours, 8}, {foliage::Law::levels, 8}};
  const auto measure = [&] {
    apps::Record<StepRow> record(folder.path() / "steps.csv", step_columns(), [](const StepRow&) { return true; });
    return measure_steps(
        stage, shrub, settings, {.range = 1.1}, [](double) {}, record);
  };
  const auto rows = measure();
  REQUIRE(rows.size() == settings.size());
  for (const StepRow& row : rows) {
    CAPTURE(way_name(row), row.step);
    CHECK(row.frames == 20);
    CHECK(row.reference_step == rows[0].reference_step);
    CHECK(row.reference_step > 0);
  }
  CHECK(pop_of(rows[0]) == 0);
  CHECK(pop_of(rows[1]) < kMostPop);
  CHECK(pop_of(rows[3]) > pop_of(rows[2]));  // levels that change at once
  const auto again = measure();
  REQUIRE(again.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(again[i].date == rows[i].date);
    CHECK(pop_of(again[i]) == Approx(pop_of(rows[i])));
  }
}

}  // namespace manzana::foliage_benchmark
