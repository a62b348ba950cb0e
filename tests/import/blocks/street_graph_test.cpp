#include "scenegraph/import/street_graph.h"

#include <catch2/catch.hpp>
#include <ctime>
#include <iostream>
#include <limits>

#include "tests/import/blocks/made_streets.h"

using namespace manzana;
using test::graph_of;
using test::street;

namespace {

// What the type promises, for any graph.
void check(const StreetGraph& graph) {
  std::vector<std::size_t> ends(graph.junctions.size(), 0);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const StreetEdge& edge = graph.edges[e];
    REQUIRE(edge.points.size() >= 2);
    REQUIRE(edge.points.front() == graph.junctions.at(edge.from).position);
    REQUIRE(edge.points.back() == graph.junctions.at(edge.to).position);
    REQUIRE_FALSE(graph.streets.at(edge.street).tunnel);
    double length = 0;
    for (std::size_t i = 1; i < edge.points.size(); ++i) {
      REQUIRE(Vec2d(edge.points[i]) != Vec2d(edge.points[i - 1]));
      length += glm::distance(Vec2d(edge.points[i]), Vec2d(edge.points[i - 1]));
    }
    REQUIRE(edge.length == Approx(length));
    REQUIRE(edge.length > 0);
    ++ends[edge.from], ++ends[edge.to];
  }
  for (std::size_t j = 0; j < ends.size(); ++j) {
    REQUIRE(graph.junctions[j].edges.size() == ends[j]);
    for (std::uint32_t e : graph.junctions[j].edges) REQUIRE((graph.edges[e].from == j || graph.edges[e].to == j));
  }
}

}  // namespace

TEST_CASE("street graph: a grid is cut at its crossings") {
  const StreetGraph graph = graph_of(test::grid(4, 3, 100));
  check(graph);
  CHECK(graph.junctions.size() == 20);
  CHECK(graph.edges.size() == 5 * 3 + 4 * 4);
}

TEST_CASE("street graph: bends are no junctions, ends are") {
  const StreetGraph graph = graph_of({street({{0, 0}, {10, 0}, {20, 5}, {30, 0}})});
  check(graph);
  REQUIRE(graph.edges.size() == 1);
  CHECK(graph.edges[0].points.size() == 4);
  CHECK(graph.junctions.size() == 2);
}

TEST_CASE("street graph: ways meet by id, not by place") {
  StreetFeature a = street({{0, 0}, {10, 0}, {20, 0}}), b = street({{10, -10}, {10, 0}, {10, 10}});
  CHECK(graph_of({a, b}).edges.size() == 4);
  b.nodes[1] = -7;
  CHECK(graph_of({a, b}).edges.size() == 2);
}

TEST_CASE("street graph: closed ways, and ways that cross themselves") {
  const StreetGraph ring = graph_of({street({{0, 0}, {10, 0}, {10, 10}, {0, 0}})});
  check(ring);
  REQUIRE(ring.edges.size() == 1);
  CHECK(ring.edges[0].from == ring.edges[0].to);
  CHECK(ring.junctions[0].edges.size() == 2);

  const StreetGraph roundabout = graph_of({street({{0, 0}, {10, 0}, {10, 10}, {0, 0}}), street({{10, 0}, {50, 0}})});
  check(roundabout);
  CHECK(roundabout.edges.size() == 3);

  const StreetGraph eight =
      graph_of({street({{0, 0}, {10, 10}, {20, 0}, {10, -10}, {0, 0}, {-9, 9}, {-9, -9}, {0, 0}})});
  check(eight);
  CHECK(eight.edges.size() == 2);

  const StreetGraph back = graph_of({street({{0, 0}, {10, 0}, {0, 0}})});
  check(back);
  CHECK(back.edges.size() == 1);
}

TEST_CASE("street graph: tunnels are left out, and do not cut what they pass") {
  StreetFeature tunnel = street({{5, 5}, {10, 0}, {20, -5}});
  tunnel.tunnel = true;
  const StreetGraph graph = graph_of({street({{0, 0}, {10, 0}, {20, 0}}), tunnel});
  check(graph);
  CHECK(graph.edges.size() == 1);
  CHECK(graph.streets.size() == 2);
}

TEST_CASE("street graph: pieces without length vanish, but not what they join") {
  StreetFeature a = street({{0, 0}, {10, 0}, {10, 0}, {20, 0}});
  a.nodes = {1, 2, 3, 4};
  StreetFeature b = street({{10, 0}, {10, 9}}), c = street({{10, 0}, {10, -9}});
  b.nodes = {2, 5};
  c.nodes = {3, 6};
  const StreetGraph graph = graph_of({a, b, c});
  check(graph);
  CHECK(graph.edges.size() == 4);
  CHECK(graph.junctions.size() == 5);
}

TEST_CASE("street graph: what can't be a street is listed") {
  StreetFeature no_ids = street({{0, 0}, {10, 0}}), nan = street({{0, 0}, {10, 0}}), one_node = nan;
  no_ids.nodes.pop_back();
  nan.line[1].y = std::numeric_limits<double>::quiet_NaN();
  one_node.nodes = {7, 7};
  std::vector<Issue> issues;
  const StreetGraph graph =
      build_street_graph({street({}), street({{1, 1}}), street({{1, 1}, {1, 1}}), no_ids, nan, one_node}, issues);
  CHECK(issues.size() == 6);
  CHECK(graph.edges.empty());
  CHECK(graph.junctions.empty());
  for (const Issue& issue : issues) CHECK((issue.where == "made" && !issue.what.empty()));
}

TEST_CASE("street graph: no streets") { check(graph_of({})); }

TEST_CASE("street graph: a million streets between crossings, timed") {
  std::vector<StreetFeature> streets = test::grid(700, 700, 80);
  for (std::size_t i = 0; i < 200; ++i) streets[i].bridge = true, streets[i].layer = 1;
  const std::clock_t start = std::clock();
  const StreetGraph graph = graph_of(std::move(streets));
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::cout << "street graph: " << graph.edges.size() << " edges in " << seconds << " s of one core\n";
  CHECK(graph.edges.size() == 2 * 701 * 700);
}
