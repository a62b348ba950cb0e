#include "scenegraph/import/street_heights.h"

#include <catch2/catch.hpp>

#include "tests/import/blocks/made_streets.h"

using namespace manzana;
using test::street;

namespace {

StreetFeature bridge(std::vector<Vec2d> line, int layer = 1, StreetClass kind = StreetClass::residential) {
  StreetFeature s = street(std::move(line), kind);
  s.bridge = true;
  s.layer = layer;
  return s;
}

// The least and greatest height of a street's points within a plan interval of x.
std::pair<double, double> heights(const StreetGraph& graph, std::uint32_t row, double x0 = -1e9, double x1 = 1e9) {
  std::pair<double, double> range{1e9, -1e9};
  for (const StreetEdge& edge : graph.edges)
    for (const Vec3d& p : edge.points)
      if (edge.street == row && p.x >= x0 && p.x <= x1)
        range = {std::min(range.first, p.z), std::max(range.second, p.z)};
  return range;
}

// Nothing falls faster than ramps do, slopes have points every 10 m, ends are those of the junctions.
void check_profile(const StreetGraph& graph, double grade = kRampGrade) {
  for (const StreetEdge& edge : graph.edges) {
    REQUIRE(edge.points.front() == graph.junctions[edge.from].position);
    REQUIRE(edge.points.back() == graph.junctions[edge.to].position);
    for (std::size_t i = 1; i < edge.points.size(); ++i) {
      const double run = glm::distance(Vec2d(edge.points[i]), Vec2d(edge.points[i - 1]));
      const double rise = std::abs(edge.points[i].z - edge.points[i - 1].z);
      CAPTURE(edge.street, edge.points[i].x, edge.points[i].y, run, rise);
      REQUIRE(run > 0);
      REQUIRE(rise <= grade * run + 1e-9);
      REQUIRE((rise == 0 || run <= 10 + 1e-9));
    }
  }
}

// A bridge from x = 0 to 60 over a street at x = 30, with streets to both sides.
std::vector<StreetFeature> overpass(int layer) {
  return {street({{-200, 0}, {0, 0}}), bridge({{0, 0}, {60, 0}}, layer), street({{60, 0}, {300, 0}}),
          street({{30, -100}, {30, 100}})};
}

}  // namespace

TEST_CASE("a bridge rises over a street, and is not joined to it") {
  const StreetGraph graph = test::graph_of(overpass(1));
  CHECK(graph.edges.size() == 4);
  check_profile(graph);
  CHECK(heights(graph, 1, 26, 34) == std::pair(kBridgeRise, kBridgeRise));
  CHECK(heights(graph, 3).second == 0);
  CHECK(heights(graph, 0, -200, -100).second == 0);
  CHECK(heights(graph, 0).second == Approx(kBridgeRise - kRampGrade * 25));  // level to 5 m from the crossing
  CHECK(heights(graph, 2).second == Approx(kBridgeRise - kRampGrade * 25));
}

TEST_CASE("two layers rise twice, a bridge without a layer once, too high layers five times") {
  CHECK(heights(test::graph_of(overpass(2)), 1).second == 2 * kBridgeRise);
  CHECK(heights(test::graph_of(overpass(0)), 1).second == kBridgeRise);
  CHECK(heights(test::graph_of(overpass(1'000'000)), 1).second == 5 * kBridgeRise);
}

TEST_CASE("equal layers do not lift each other") {
  std::vector<StreetFeature> streets = overpass(1);
  streets[3].bridge = true;
  streets[3].layer = 1;
  const StreetGraph graph = test::graph_of(streets);
  CHECK(heights(graph, 1).second <= 1.5);
  CHECK(heights(graph, 3).second <= 1.5);
}

TEST_CASE("a node of the street under the bridge's line, or of the bridge over the street's") {
  std::vector<StreetFeature> below = overpass(1), above = overpass(1), both = overpass(1);
  below[3] = street({{30, -100}, {30, 0}, {30, 100}});
  above[1] = bridge({{0, 0}, {30, 0}, {60, 0}});
  both[1] = above[1];
  both[3] = below[3];
  both[3].nodes[1] = -7;  // at the same place, but another node
  for (const auto& streets : {below, above, both}) {
    const StreetGraph graph = test::graph_of(streets);
    CHECK(graph.edges.size() == 4);
    CHECK(heights(graph, 1, 26, 34) == std::pair(kBridgeRise, kBridgeRise));
  }
}

TEST_CASE("over water or nothing: a gentle arch") {
  std::vector<StreetFeature> streets = overpass(1);
  streets.pop_back();
  const StreetGraph graph = test::graph_of(streets);
  check_profile(graph, 0.11);  // 1.5 m * pi / 60 m at the steepest
  CHECK(heights(graph, 1).second == Approx(1.5));
  CHECK(heights(graph, 1, 29, 31).second == Approx(1.5));
  CHECK(heights(graph, 0).second == 0);
  const StreetGraph small =
      test::graph_of({street({{-9, 0}, {0, 0}}), bridge({{0, 0}, {6, 0}}), street({{6, 0}, {9, 0}})});
  CHECK(heights(small, 1).second == Approx(6.0 / 15).margin(0.05));
}

TEST_CASE("a bridge in pieces has one arch, and no height at its ends") {
  const StreetGraph graph = test::graph_of({street({{-50, 0}, {0, 0}}), bridge({{0, 0}, {40, 0}}),
                                            bridge({{40, 0}, {100, 0}}), street({{100, 0}, {150, 0}})});
  check_profile(graph, 0.11);
  CHECK(heights(graph, 1, 39.9, 40.1).first > 1.2);
  CHECK(heights(graph, 1, -1, 1).second == 0);
  CHECK(heights(graph, 2, 99, 101).second == Approx(0).margin(1e-9));
}

TEST_CASE("a long viaduct stays up between its crossings, across its pieces") {
  std::vector<StreetFeature> streets{street({{-200, 0}, {0, 0}}),      bridge({{0, 0}, {300, 0}}),
                                     bridge({{300, 0}, {900, 0}}),     bridge({{900, 0}, {1200, 0}}),
                                     street({{1200, 0}, {1400, 0}}),   street({{100, -50}, {100, 50}}),
                                     street({{1100, -50}, {1100, 50}})};
  const StreetGraph graph = test::graph_of(streets);
  check_profile(graph);
  CHECK(heights(graph, 1, 100, 300).first == kBridgeRise);
  CHECK(heights(graph, 2) == std::pair(kBridgeRise, kBridgeRise));
  CHECK(heights(graph, 3, 900, 1100).first == kBridgeRise);
  CHECK(heights(graph, 1, 0, 0).first < 0.5);
}

TEST_CASE("ramps fall along all streets that are joined, highest first") {
  // The bridge ends at a junction of three; the second overpass is nearer to one branch.
  const StreetGraph graph =
      test::graph_of({bridge({{0, 0}, {20, 0}}), street({{10, -50}, {10, 50}}), street({{20, 0}, {20, 40}, {20, 200}}),
                      street({{20, 0}, {45, 0}}), bridge({{45, 0}, {65, 0}}, 2), street({{55, -30}, {55, 30}})});
  check_profile(graph);
  CHECK(heights(graph, 4).second == 2 * kBridgeRise);
  const double at_20 = 2 * kBridgeRise - kRampGrade * 30;  // from x = 50
  CHECK(heights(graph, 3, 20, 20).first == Approx(at_20));
  CHECK(heights(graph, 2).second == Approx(at_20));
  CHECK(heights(graph, 2).first == 0);
}

TEST_CASE("a ring of bridges over nothing ends, on the ground") {
  const StreetGraph graph = test::graph_of({bridge({{0, 0}, {50, 0}, {50, 50}, {0, 0}})});
  check_profile(graph);
  CHECK(heights(graph, 0).second <= 1.5);
}

TEST_CASE("a spiral ramp does not lift itself, a ramp that joins a bridge and passes under it does") {
  const StreetGraph spiral = test::graph_of({bridge({{0, 0}, {50, 0}, {50, 50}, {25, 50}, {25, -50}})});
  CHECK(heights(spiral, 0).second <= 1.5);
  const StreetGraph joined =
      test::graph_of({bridge({{0, 0}, {100, 0}}), street({{100, 0}, {100, 80}, {50, 80}, {50, -80}})});
  check_profile(joined);
  CHECK(heights(joined, 0, 46, 54) == std::pair(kBridgeRise, kBridgeRise));
}
