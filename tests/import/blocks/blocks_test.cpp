#include "scenegraph/import/blocks.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <iostream>

#include "scenegraph/import/street_faces.h"
#include "tests/import/blocks/made_streets.h"

using namespace manzana;
using test::graph_of;
using test::street;

namespace {

std::size_t face_count(std::vector<StreetFeature> streets) {
  return StreetFaces(graph_of(std::move(streets))).faces().size();
}

// What must hold for any plan.
void check(const StreetGraph& graph, const std::vector<Vec2d>& centers, const BlockPlan& plan) {
  REQUIRE(plan.of.size() == centers.size());
  REQUIRE(plan.half_streets.size() == 2 * graph.edges.size());
  std::vector<bool> used(plan.blocks.size());
  for (const auto& rows : {plan.of, plan.half_streets})
    for (std::uint32_t b : rows) {
      REQUIRE(b < used.size());
      used[b] = true;
    }
  REQUIRE(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
}

BlockPlan plan_of(const StreetGraph& graph, const std::vector<Vec2d>& centers, const BlockOptions& options = {}) {
  BlockPlan plan = find_blocks(graph, centers, options);
  check(graph, centers, plan);
  return plan;
}

// Even-odd by brute force over all rings.
bool inside(const Polygon& shape, const Vec2d& p) {
  bool in = false;
  const auto flip = [&](const std::vector<Vec2d>& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2d &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
  };
  flip(shape.outer);
  for (const auto& hole : shape.holes) flip(hole);
  return in;
}

// A grid, bent by a smooth map, with a diagonal avenue, dead ends and a street that crosses without a node.
std::vector<StreetFeature> crooked_city() {
  std::vector<StreetFeature> streets = test::grid(12, 9, 90);
  streets.push_back(street({{0, 0}, {1080, 720}}, StreetClass::primary));
  streets.push_back(street({{90, 90}, {120, 120}, {150, 110}}));
  streets.push_back(street({{450, 810}, {360, 180}}));
  for (StreetFeature& s : streets)
    for (Vec2d& p : s.line) p = {p.x + 15 * std::sin(p.y / 70), p.y + 12 * std::sin(p.x / 50)};
  return streets;
}

}  // namespace

TEST_CASE("faces: a grid city") {
  CHECK(face_count(test::grid(4, 3, 100)) == 12);
  CHECK(face_count(test::grid(1, 1, 100)) == 1);
}

TEST_CASE("faces: dead ends bound nothing") {
  std::vector<StreetFeature> streets = test::grid(4, 3, 100);
  streets.push_back(street({{100, 100}, {150, 150}, {160, 150}}));         // ends inside a block
  streets.push_back(street({{150, 150}, {150, 160}}));                     // and forks
  streets.push_back(street({{0, 0}, {-300, 0}}));                          // leaves the city
  streets.push_back(street({{200, 200}, {250, 250}, {250, 350}}));         // crosses others without a node
  streets.push_back(street({{1000, 0}, {1100, 0}}));                       // joined to nothing
  streets.push_back(street({{200, 100}, {300, 200}}, StreetClass::path));  // carries no traffic
  CHECK(face_count(streets) == 12);
}

TEST_CASE("faces: a diagonal avenue cuts the blocks it crosses, with nodes or without") {
  std::vector<StreetFeature> streets = test::grid(4, 4, 100);
  streets.push_back(street({{0, 0}, {100, 100}, {200, 200}, {300, 300}, {400, 400}}));
  CHECK(face_count(streets) == 20);
  streets.back() = street({{-30, 0}, {400, 430}});
  CHECK(face_count(streets) == 16);  // a dead end at both ends: it has no node with the rest
  streets.back() = street({{0, 0}, {400, 400}});
  CHECK(face_count(streets) == 20);  // both its ends are nodes of the grid, the crossings are not
}

TEST_CASE("faces: tunnels bound nothing, bridges do") {
  std::vector<StreetFeature> streets = test::grid(2, 1, 100);
  CHECK(face_count(streets) == 2);
  streets[1].tunnel = true;
  CHECK(face_count(streets) == 1);
  streets[1].tunnel = false;
  streets[1].bridge = true;
  CHECK(face_count(streets) == 2);
}

TEST_CASE("faces: a ring in a face is a face, and a hole in the other") {
  std::vector<StreetFeature> streets = test::grid(1, 1, 100);
  streets.push_back(street({{40, 40}, {60, 40}, {60, 60}, {40, 60}, {40, 40}}));
  streets.back().circular = true;
  const StreetFaces faces(graph_of(streets));
  REQUIRE(faces.faces().size() == 2);
  CHECK(faces.locate({50, 50}) != faces.locate({10, 10}));
  CHECK(faces.locate({150, 50}) == kNoFace);
  CHECK(faces.faces()[faces.locate({10, 10})].centroid.area == Approx(9600));
}

TEST_CASE("every centre goes to the face that holds it: brute force agrees") {
  const StreetGraph graph = graph_of(crooked_city());
  const StreetFaces faces(graph);
  CHECK(faces.faces().size() > 110);
  const std::vector<Vec2d> centers = test::random_points(5, 5000, {-100, -100}, {1200, 950});
  for (const Vec2d& p : centers) {
    std::uint32_t expected = kNoFace, count = 0;
    for (std::uint32_t f = 0; f < faces.faces().size(); ++f)
      if (inside(faces.faces()[f].shape, p)) expected = f, ++count;
    REQUIRE(count <= 1);
    REQUIRE(faces.locate(p) == expected);
  }
  const BlockPlan plan = plan_of(graph, centers);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const std::uint32_t face = faces.locate(centers[i]);
    REQUIRE(plan.blocks[plan.of[i]].fallback == (face == kNoFace));
    if (face != kNoFace) REQUIRE(plan.blocks[plan.of[i]].center == faces.faces()[face].centroid.center);
  }
}

TEST_CASE("centres on borders go to the first face, always the same") {
  const StreetGraph graph = graph_of(test::grid(3, 3, 100));
  const StreetFaces faces(graph);
  std::vector<Vec2d> centers;
  for (int x = 0; x <= 6; ++x)
    for (int y = 0; y <= 6; ++y) centers.emplace_back(x * 50, y * 50);
  const BlockPlan plan = plan_of(graph, centers), again = plan_of(graph, centers);
  CHECK(plan.of == again.of);
  for (std::size_t i = 0; i < centers.size(); ++i) {
    std::uint32_t first = kNoFace;
    for (std::uint32_t f = 0; f < faces.faces().size(); ++f)
      if (faces.faces()[f].box.contains(centers[i])) first = std::min(first, f);
    CHECK(faces.locate(centers[i]) == first);
    CHECK_FALSE(plan.blocks[plan.of[i]].fallback);
  }
}

TEST_CASE("no streets: every object has a block, blocks are of like weight") {
  const StreetGraph none = graph_of({});
  CHECK(plan_of(none, {}).blocks.empty());
  CHECK(plan_of(none, {{3, 4}}).blocks.size() == 1);
  CHECK(plan_of(none, {{3, 4}}).blocks[0].center == Vec2d(3, 4));
  CHECK(plan_of(none, std::vector<Vec2d>(500, Vec2d(1, 1))).blocks.size() == 1);
  const std::vector<Vec2d> centers = test::random_points(1, 10000, {0, 0}, {2000, 2000});
  const BlockPlan plan = plan_of(none, centers);
  std::vector<std::uint32_t> weight(plan.blocks.size(), 0);
  for (std::uint32_t b : plan.of) ++weight[b];
  CHECK(*std::max_element(weight.begin(), weight.end()) <= 64);
  CHECK(plan.blocks.size() < 4 * 10000 / 64 * 2);
}

TEST_CASE("a very large face is open country, a heavy one is cut") {
  const StreetGraph large = graph_of(test::grid(1, 1, 3000)), block = graph_of(test::grid(1, 1, 300));
  const std::vector<Vec2d> far_apart = test::random_points(2, 100, {10, 10}, {2990, 2990});
  const BlockPlan country = plan_of(large, far_apart);
  CHECK(country.blocks.size() > 10);
  for (const BlockGround& b : country.blocks) CHECK(b.fallback);
  CHECK(plan_of(block, test::random_points(2, 8 * 64, {1, 1}, {299, 299})).blocks[0].fallback == false);
  const std::vector<Vec2d> park = test::random_points(2, 8 * 64 + 1, {1, 1}, {299, 299});
  const BlockPlan cut = plan_of(block, park);
  std::vector<std::uint32_t> weight(cut.blocks.size(), 0);
  for (std::uint32_t b : cut.of) ++weight[b];
  CHECK(*std::max_element(weight.begin(), weight.end()) <= 64);
}

TEST_CASE("blocks without objects and half-streets are dropped") {
  std::vector<StreetFeature> streets = test::grid(1, 1, 100);
  for (StreetFeature& s : streets) s.one_way = true;
  // The grid's streets run up and right: kerbs on the right fall outside along x = 100 and y = 0, inside elsewhere.
  const BlockPlan plan = plan_of(graph_of(streets), {});
  REQUIRE(plan.blocks.size() == 2);
  CHECK((!plan.blocks[0].fallback && plan.blocks[1].fallback));
  // Driven counter-clockwise only, a ring's kerbs are all outside: no block inside.
  std::vector<StreetFeature> ring = {street({{0, 0}, {50, 0}, {50, 50}, {0, 50}, {0, 0}})};
  CHECK(plan_of(graph_of(ring), {}).blocks.size() == 2);
  ring[0].one_way = true;
  const BlockPlan outside = plan_of(graph_of(ring), {});
  REQUIRE(outside.blocks.size() == 1);
  CHECK(outside.blocks[0].fallback);
}

TEST_CASE("half-streets: opposite directions lie on opposite faces, by the side traffic drives on") {
  const StreetGraph graph = graph_of(test::grid(5, 5, 100));
  const StreetFaces faces(graph);
  for (bool left : {false, true}) {
    const BlockPlan plan = plan_of(graph, {}, {.left_hand_traffic = left});
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      const Vec2d a(graph.edges[e].points.front()), b(graph.edges[e].points.back());
      const Vec2d right = 0.3 * Vec2d(b.y - a.y, a.x - b.x), mid = 0.5 * (a + b);
      CHECK(plan.half_streets[2 * e] != plan.half_streets[2 * e + 1]);
      for (std::size_t against : {0, 1}) {
        const std::uint32_t face = faces.locate(mid + (left == (against == 1) ? right : -right));
        const BlockGround& block = plan.blocks[plan.half_streets[2 * e + against]];
        CHECK(block.fallback == (face == kNoFace));
        if (face != kNoFace) CHECK(block.center == faces.faces()[face].centroid.center);
      }
    }
  }
}

TEST_CASE("half-streets: a dead end's are of the face around it, a path's too") {
  std::vector<StreetFeature> streets = test::grid(1, 1, 100);
  streets.push_back(street({{0, 0}, {50, 50}}));
  streets.push_back(street({{50, 50}, {60, 70}}, StreetClass::path));
  const StreetGraph graph = graph_of(streets);
  const BlockPlan plan = plan_of(graph, {{50, 20}});
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    if (graph.edges[e].street >= 4)
      for (std::size_t half : {2 * e, 2 * e + 1}) CHECK(plan.half_streets[half] == plan.of[0]);
}

TEST_CASE("half-streets: one far away makes no huge block") {
  const StreetGraph graph = graph_of({street({{90000, 0}, {90100, 0}}), street({{0, 0}, {100, 0}})});
  const BlockPlan plan = plan_of(graph, {{50, 20}});
  CHECK(plan.blocks.size() == 2);
  for (const BlockGround& b : plan.blocks)
    CHECK((std::abs(b.center.x - 50) < 100 || std::abs(b.center.x - 90050) < 100));
}

TEST_CASE("a direction in which nobody drives makes no block of its own") {
  // Two carriageways of an avenue 6 m apart across a block, northwards and southwards, with nodes at both ends.
  const std::vector<StreetFeature> streets = {
      street({{0, 0}, {100, 0}, {106, 0}, {200, 0}, {200, 100}, {106, 100}, {100, 100}, {0, 100}, {0, 0}}),
      street({{106, 0}, {106, 100}}), street({{100, 100}, {100, 0}})};
  for (bool one_way : {false, true}) {
    std::vector<StreetFeature> avenue = streets;
    for (StreetFeature& s : avenue) s.one_way = one_way, s.width = 3;
    const StreetGraph graph = graph_of(avenue);
    const std::uint32_t median = StreetFaces(graph).locate({103, 50});
    REQUIRE(median != kNoFace);
    const BlockPlan plan = plan_of(graph, {{50, 50}, {150, 50}});
    const Vec2d center = StreetFaces(graph).faces()[median].centroid.center;
    const auto made =
        std::count_if(plan.blocks.begin(), plan.blocks.end(), [&](const BlockGround& b) { return b.center == center; });
    CHECK(made == (one_way ? 0 : 1));
  }
  const StreetGraph path = graph_of({street({{0, 0}, {50, 0}}, StreetClass::path)});
  CHECK(plan_of(path, {}).blocks.size() == 1);
}

TEST_CASE("blocks do not depend on the order of streets or objects") {
  std::vector<StreetFeature> streets = crooked_city();
  const std::vector<Vec2d> centers = test::random_points(9, 500, {-100, -100}, {1200, 950});
  const BlockPlan a = plan_of(graph_of(streets), centers);
  std::reverse(streets.begin(), streets.end());
  const BlockPlan b = plan_of(graph_of(streets), {centers.rbegin(), centers.rend()});
  REQUIRE(a.blocks.size() == b.blocks.size());
  for (std::size_t i = 0; i < centers.size(); ++i)
    CHECK(glm::distance(a.blocks[a.of[i]].center, b.blocks[b.of[centers.size() - 1 - i]].center) < 1e-6);
}

TEST_CASE("blocks of a large city, timed") {
  const StreetGraph graph = graph_of(test::grid(300, 300, 90));
  const std::vector<Vec2d> centers = test::random_points(4, 300000, {0, 0}, {27000, 27000});
  const std::clock_t start = std::clock();
  const BlockPlan plan = plan_of(graph, centers);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::cout << "blocks: " << plan.blocks.size() << " of " << graph.edges.size() << " edges and " << centers.size()
            << " objects in " << seconds << " s of one core\n";
  CHECK(plan.blocks.size() >= 90000);
}
