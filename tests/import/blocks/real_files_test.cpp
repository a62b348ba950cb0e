#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <iostream>

#include "scenegraph/import/blocks.h"
#include "scenegraph/import/import.h"
#include "scenegraph/import/street_faces.h"
#include "tests/support/data.h"

using namespace manzana;

namespace {

struct Clock {
  std::clock_t start = std::clock();
  double seconds() const { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }
};

std::vector<Vec2d> centers_of(const CityFeatures& city, const StreetGraph& graph) {
  std::vector<Vec2d> centers;
  for (const BuildingFeature& b : city.buildings) centers.push_back(centroid(b.footprint).center);
  for (const TreeFeature& t : city.trees) centers.push_back(t.position);
  for (const StreetEdge& e : graph.edges) centers.emplace_back(e.points[e.points.size() / 2]);
  return centers;
}

struct Bounds {
  std::size_t blocks_least, blocks_most;
  double fallback_most;  // share of the objects
};

void check_city(const std::string& name, const Bounds& bounds) {
  const auto file = data_file("osm/" + name + ".osm.pbf");
  if (!file) return;
  CityFeatures city = read_osm(*file, {});
  std::vector<Issue> issues;
  const Clock graph_clock;
  const StreetGraph graph = build_street_graph(std::move(city.streets), issues);
  const double graph_s = graph_clock.seconds();
  const std::vector<Vec2d> centers = centers_of(city, graph);
  const Clock blocks_clock;
  const BlockPlan plan = find_blocks(graph, centers, {.left_hand_traffic = city.left_hand_traffic});
  const double blocks_s = blocks_clock.seconds();

  std::vector<std::size_t> weight(plan.blocks.size(), 0);
  std::size_t fallback = 0;
  for (std::uint32_t b : plan.of) ++weight[b], fallback += plan.blocks[b].fallback ? 1 : 0;
  std::sort(weight.begin(), weight.end());
  REQUIRE_FALSE(weight.empty());
  const auto cells = std::count_if(plan.blocks.begin(), plan.blocks.end(), [](const auto& b) { return b.fallback; });
  double highest = 0;
  for (const StreetEdge& e : graph.edges)
    for (const Vec3d& p : e.points) highest = std::max(highest, p.z);
  std::cout << name << ": " << graph.edges.size() << " edges in " << graph_s << " s, highest point " << highest
            << " m; " << plan.blocks.size() << " blocks (" << cells << " fell back) in " << blocks_s << " s; "
            << centers.size() << " objects (" << fallback << " in fallback blocks), a block: median "
            << weight[weight.size() / 2] << ", largest " << weight.back() << "; issues " << issues.size() << '\n';
  CHECK(plan.blocks.size() >= bounds.blocks_least);
  CHECK(plan.blocks.size() <= bounds.blocks_most);
  CHECK(static_cast<double>(fallback) <= bounds.fallback_most * static_cast<double>(centers.size()));
  CHECK(weight.back() <= 8 * 64);
  CHECK(highest <= 5 * kBridgeRise);
  CHECK(plan.half_streets.size() == 2 * graph.edges.size());
  CHECK(*std::max_element(plan.half_streets.begin(), plan.half_streets.end()) < plan.blocks.size());
}

}  // namespace

TEST_CASE("blocks of Helsinki's centre") { check_city("helsinki-centre", {100, 1000, 0.5}); }
TEST_CASE("blocks of New York's Lower East Side") { check_city("nyc-lower-east-side", {20, 300, 0.5}); }
TEST_CASE("blocks of Liechtenstein") { check_city("liechtenstein-2015", {500, 4000, 0.9}); }
TEST_CASE("blocks of Heidelberg") { check_city("heidelberg", {20, 1000, 0.9}); }
TEST_CASE("blocks of Porto Alegre") { check_city("porto-alegre", {2000, 8000, 0.5}); }
