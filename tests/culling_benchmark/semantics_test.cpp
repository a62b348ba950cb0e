#include "apps/culling_benchmark/semantics.h"

#include <catch2/catch.hpp>

#include "culling/baselines/cases.h"
#include "scenegraph/classes.h"

using namespace manzana;
using namespace manzana::culling_benchmark;

TEST_CASE("semantics: both ways find the same") {
  const baselines::City city = baselines::make_city(5000, 3);
  const std::vector<culling::ClassMask> classes = classes_of(city);
  const culling::BqrTree tree = build_bqr_tree(city.blocks, {city.first, city.boxes, classes});
  std::uint64_t found = 0;
  for (int i = 0; i < 40; ++i) {
    const auto planes = make_planes(tree, make_frustum(baselines::flight(city, 1e30, i / 39.0)));
    for (const char* name : {"tree", "building20", "conifer", "street"}) {
      culling::Answer all(tree), some(tree);
      cull(tree, planes, all);
      (void)ordered(all);
      cull(tree, planes, some, {.classes = class_named(name).value()});
      std::vector<culling::ObjectRun> after;
      filter_after(tree, all, class_named(name).value(), after);
      const auto in = ordered(some);
      REQUIRE(std::equal(in.begin(), in.end(), after.begin(), after.end()));
      found += count(after);
    }
  }
  CHECK(found > 1000);
}

TEST_CASE("semantics: a row for everything and one for each that is asked") {
  const SemanticsRun run = run_semantics({.cities = {2000}, .frames = 10, .rounds = 3}, [](double) {});
  REQUIRE(run.rows.size() == 6);
  for (const SemanticsRow& row : run.rows) {
    CHECK(row.in_us > 0);
    CHECK(row.share <= 1);
    CHECK(row.in_nodes > 0);
  }
  CHECK(run.rows[0].in_nodes == run.rows[0].after_nodes);
  CHECK(semantics_md(run).find("building40") != std::string::npos);
}
