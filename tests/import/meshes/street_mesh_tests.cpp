#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/import/meshes/mesh_checks.h"

using namespace checks;

namespace {

/// Streets that share end points (equal coordinates) meet there; a row of features an edge.
struct Town {
  StreetGraph graph;

  std::uint32_t junction(const Vec3d& p) {
    for (std::uint32_t j = 0; j < graph.junctions.size(); ++j)
      if (graph.junctions[j].position == p) return j;
    graph.junctions.push_back({p, {}});
    return static_cast<std::uint32_t>(graph.junctions.size() - 1);
  }
  void street(const std::vector<Vec3d>& points, StreetClass kind, double width, int lanes, bool bridge = false) {
    StreetFeature s;
    s.where = "way " + std::to_string(graph.streets.size());
    s.kind = kind;
    s.width = width;
    s.lanes = lanes;
    s.bridge = bridge;
    StreetEdge e{junction(points.front()), junction(points.back()), points, 0, 0};
    e.street = static_cast<std::uint32_t>(graph.streets.size());
    const auto row = static_cast<std::uint32_t>(graph.edges.size());
    graph.junctions[e.from].edges.push_back(row);
    graph.junctions[e.to].edges.push_back(row);
    graph.streets.push_back(s);
    graph.edges.push_back(e);
  }
};

struct Laid {
  std::vector<Issue> issues;
  std::vector<SurfacePiece> pieces;

  explicit Laid(const Town& town) : pieces(street_pieces(town.graph, issues)) {}
  double area(Material kind) const {
    double sum = 0;
    for (const SurfacePiece& p : pieces) sum += checks::area(p.plan, kind);
    return sum;
  }
  std::string fault() const {
    for (const SurfacePiece& p : pieces)
      if (std::string what = checks::fault(p.plan); !what.empty()) return what;
    return {};
  }
};

/// Height of the topmost upward triangle over a plan point, and its material; -1 where there is none.
std::pair<double, Material> top(const Laid& laid, const Vec2d& at) {
  std::pair<double, Material> best{-1, Material::count};
  for (const SurfacePiece& piece : laid.pieces)
    for (std::size_t i = 0; i < piece.plan.indices.size(); i += 3) {
      const auto p = [&](std::size_t k) {
        return Vec3d(piece.plan.vertices[piece.plan.indices[i + k]].position) + Vec3d(piece.center, 0);
      };
      const auto side = [&](const Vec3d& a, const Vec3d& b) {
        return (b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x);
      };
      const double u = side(p(1), p(2)), v = side(p(2), p(0)), w = side(p(0), p(1)), sum = u + v + w;
      if (!(sum > 1e-6) || std::min({u, v, w}) < -1e-4 * std::max(1.0, sum)) continue;
      const double z = (u * p(0).z + v * p(1).z + w * p(2).z) / sum;
      if (z > best.first) best = {z, checks::material(piece.plan.vertices[piece.plan.indices[i]])};
    }
  return best;
}

bool carriageway(Material m) { return m == Material::asphalt || m == Material::junction; }

}  // namespace

TEST_CASE("a straight street: area, lanes, pavements, few triangles") {
  Town town;
  town.street({{0, 0, 0}, {50, 0, 0}, {100, 0, 0}}, StreetClass::residential, 6, 2);
  const Laid laid(town);
  CHECK(laid.issues.empty());
  CHECK(laid.fault() == "");
  REQUIRE(laid.pieces.size() == 1);
  CHECK(laid.area(Material::asphalt) == Approx(600));
  const double caps = std::numbers::pi * (3 * 3 + 4.8 * 4.8);  // round ends, of both
  CHECK(laid.area(Material::pavement) + laid.area(Material::junction) == Approx(960 + caps).epsilon(0.03));
  for (const CityVertex& v : laid.pieces[0].plan.vertices) {
    if (checks::material(v) != Material::asphalt) continue;
    CHECK(v.position.z == Approx(0.124));
    const Vec2d plan = Vec2d(Vec2(v.position)) + laid.pieces[0].center;
    CHECK(v.uv.x == Approx(plan.x).margin(1e-4));
    CHECK(v.uv.y == Approx((3 - plan.y) / 3).margin(1e-4));  // lanes from the left edge
  }
  CHECK(laid.pieces[0].plan.indices.size() / 3 < 50);
}

TEST_CASE("long streets come in pieces, without gaps") {
  Town town;
  town.street({{0, 0, 0}, {1000, 0, 0}}, StreetClass::primary, 10, 4);
  const Laid laid(town);
  CHECK(laid.pieces.size() == 7);
  CHECK(laid.area(Material::asphalt) == Approx(10000));
  for (const SurfacePiece& p : laid.pieces)
    for (const CityVertex& v : p.plan.vertices) CHECK(std::abs(double(v.position.x)) <= kSurfacePiece / 2 + 8);
  for (double x = 1; x < 1000; x += 3.7) CHECK(top(laid, {x, 1}).second == Material::asphalt);
}

TEST_CASE("bends have their width and no spikes, however sharp") {
  for (double degrees = -179; degrees < 180; degrees += 7) {
    INFO(degrees << " degrees");
    const double angle = degrees * std::numbers::pi / 180;
    Town town;
    const Vec3d turn{80, 0, 0}, end = turn + 80.0 * Vec3d{std::cos(angle), std::sin(angle), 0};
    town.street({{0, 0, 0}, turn, end}, StreetClass::service, 8, 2);
    const Laid laid(town);
    CHECK(laid.fault() == "");
    for (const SurfacePiece& p : laid.pieces)
      for (const CityVertex& v : p.plan.vertices) {
        const Vec2d q = Vec2d(v.position) + p.center;
        const double to_bend = glm::distance(q, Vec2d(turn));
        CHECK((to_bend < 4 * 1.6 || std::abs(q.y) < 4.01 ||
               std::abs((q.x - 80) * std::sin(angle) - q.y * std::cos(angle)) < 4.01));
      }
    if (std::abs(degrees) < 100) {
      const double ends = std::numbers::pi * 16;
      CHECK(laid.area(Material::asphalt) + laid.area(Material::junction) == Approx(160 * 8 + ends).epsilon(0.02));
    }
    for (double s = 0.5; s < 80; s += 1.3) {  // covered along both legs, up to the edges away from the bend
      CHECK(carriageway(top(laid, {s, 0}).second));
      CHECK(carriageway(top(laid, Vec2d(turn + (end - turn) * (s / 80))).second));
    }
  }
}

TEST_CASE("random streets: finite, covered, close to length times width") {
  const std::uint64_t seed = 4099;
  INFO("seed " << seed);
  Random random{seed};
  for (int i = 0; i < 60; ++i) {
    Town town;
    const Vec2d far = i % 2 == 0 ? Vec2d{0, 0} : Vec2d{1e5, -1e5};
    std::vector<Vec3d> line{{far, 0}};
    double heading = random.between(0, 6), length = 0;
    for (int k = random.whole(1, 15); k > 0; --k) {
      heading += random.between(-0.6, 0.6);
      const double step = random.between(12, 90);
      length += step;
      line.push_back(line.back() + step * Vec3d{std::cos(heading), std::sin(heading), 0});
    }
    town.street(line, StreetClass::motorway, 7, 2);
    const Laid laid(town);
    CHECK(laid.fault() == "");
    const double caps = std::numbers::pi * 3.5 * 3.5;
    CHECK(laid.area(Material::asphalt) + laid.area(Material::junction) == Approx(length * 7 + caps).epsilon(0.03));
    for (std::size_t k = 1; k < line.size(); ++k)
      for (double t = 0.02; t < 1; t += 0.19)
        CHECK(carriageway(top(laid, Vec2d(line[k - 1] + (line[k] - line[k - 1]) * t)).second));
  }
}

TEST_CASE("junctions of any number of streets have no hole and no lines") {
  const std::uint64_t seed = 99;
  INFO("seed " << seed);
  Random random{seed};
  for (int i = 0; i < 60; ++i) {
    Town town;
    const int arms = random.whole(2, 6);
    double angle = random.between(0, 6), half = 100;
    for (int k = 0; k < arms; ++k) {
      angle += random.between(0.35, 3.0) * 2 / arms;
      const double width = random.between(4, 14);
      half = std::min(half, width / 2);
      const Vec3d end = 90.0 * Vec3d{std::cos(angle), std::sin(angle), 0};
      town.street(random.unit() < 0.5 ? std::vector<Vec3d>{{0, 0, 0}, end} : std::vector<Vec3d>{end, {0, 0, 0}},
                  StreetClass::residential, width, 2);
    }
    const Laid laid(town);
    INFO("town " << i << ", " << arms << " arms");
    CHECK(laid.fault() == "");
    for (int k = 0; k < 40; ++k) {
      const double a = random.between(0, 6.3), r = half * 0.98 * std::sqrt(random.unit());
      const Material there = top(laid, {r * std::cos(a), r * std::sin(a)}).second;
      CHECK(carriageway(there));
      if (arms > 3) CHECK(there == Material::junction);
    }
  }
}

TEST_CASE("a main street keeps its lines where a side street turns off") {
  Town town;
  town.street({{-80, 0, 0}, {0, 0, 0}}, StreetClass::primary, 8, 2);
  town.street({{0, 0, 0}, {80, 0, 0}}, StreetClass::primary, 8, 2);
  town.street({{0, 0, 0}, {0, 70, 0}}, StreetClass::residential, 6, 2);
  const Laid laid(town);
  CHECK(laid.fault() == "");
  CHECK(top(laid, {0.5, 1}).second == Material::asphalt);
  CHECK(top(laid, {0, 4.7}).second == Material::junction);  // the mouth of the side street
  CHECK(top(laid, {0, 30}).second == Material::asphalt);
  CHECK(top(laid, {20, 5.5}).second == Material::pavement);
}

TEST_CASE("ribbons of different classes keep apart, so that crossings do not flicker") {
  Town town;
  double x = 0;
  for (const StreetClass kind :
       {StreetClass::motorway, StreetClass::primary, StreetClass::secondary, StreetClass::residential,
        StreetClass::service, StreetClass::pedestrian, StreetClass::path, StreetClass::track})
    town.street({{x += 100, 0, 0}, {x, 80, 0}}, kind, 4, 1);
  const Laid laid(town);
  std::vector<double> heights;
  for (double at = 100; at <= 800; at += 100) heights.push_back(top(laid, {at + 0.3, 40}).first);
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 1; i < heights.size(); ++i) CHECK(heights[i] - heights[i - 1] > 0.003);
  CHECK(heights[0] > 0.055);  // above the areas
}

TEST_CASE("bridges have decks and parapets, ramps have walls down to the ground") {
  Town town;
  town.street({{0, 0, 0}, {70, 0, 5.6}}, StreetClass::residential, 6, 2);
  town.street({{70, 0, 5.6}, {130, 0, 5.6}}, StreetClass::residential, 6, 2, true);
  town.street({{130, 0, 5.6}, {200, 0, 0}}, StreetClass::residential, 6, 2);
  const Laid laid(town);
  CHECK(laid.fault() == "");
  CHECK(top(laid, {100, 0}).first == Approx(5.6 + 0.124).margin(1e-3));
  CHECK(top(laid, {100, 4.9}).first == Approx(5.6 + 0.08 + 1.1).margin(1e-3));  // on the parapet
  CHECK(top(laid, {35, 0}).first == Approx(2.8 + 0.124).margin(0.01));
  CHECK(top(laid, {3, 4.9}).first < 0.5);  // no parapet where the ramp begins
  double low = 1e9;
  for (const SurfacePiece& p : laid.pieces)
    for (const CityVertex& v : p.plan.vertices) {
      if (checks::material(v) != Material::concrete) continue;
      low = std::min(low, Vec3d(v.position).z);
    }
  CHECK(low < 0);
  CHECK(laid.area(Material::concrete) > 2 * 60 * (1.1 + 0.8));
}

TEST_CASE("squares are laid as areas, other closed streets as rings") {
  StreetFeature square;
  square.kind = StreetClass::pedestrian;
  square.circular = true;
  square.line = {{0, 0}, {40, 0}, {40, 30}, {0, 30}, {0, 0}};
  Town town;
  town.street({{0, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}, {0, 0, 0}}, StreetClass::pedestrian, 4, 1);
  town.graph.streets[0].circular = true;
  town.graph.streets[0].line = square.line;
  const Laid laid(town);
  CHECK(laid.issues.empty());
  CHECK(laid.area(Material::pavement) == Approx(1200));
  town.graph.streets[0].circular = false;
  const Laid ring(town);
  CHECK(ring.fault() == "");
  CHECK(ring.area(Material::pavement) == Approx(140 * 4).epsilon(0.02));
}

TEST_CASE("streets that cannot be laid are told") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Town town;
  town.street({{0, 0, 0}, {10, nan, 0}}, StreetClass::primary, 4, 2);
  town.street({{0, 0, 0}, {10, 0, 0}}, StreetClass::primary, nan, 2);
  town.street({{0, 0, 0}, {0.01, 0, 0}}, StreetClass::primary, 5, 0);
  town.street({{5, 5, 0}, {9, 5, 0}, {9, 9, 0}, {5, 5, 0}}, StreetClass::primary, 30, 2);
  const Laid laid(town);
  CHECK(laid.issues.size() == 2);
  CHECK(laid.fault() == "");
}
