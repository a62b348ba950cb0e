#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/roof_mesh.h"
#include "tests/import/meshes/mesh_checks.h"

using namespace checks;

namespace {

constexpr double kWeld = 5e-4;  // metres: half a millimetre, many float roundings at 100 m
const RoofShape kShapes[] = {RoofShape::flat,      RoofShape::gabled,   RoofShape::hipped,
                             RoofShape::pyramidal, RoofShape::skillion, RoofShape::dome};

struct Built {
  CityMesh mesh;
  std::vector<Issue> issues;
};

/// In a block frame at `ground`: 0 for the anchor.
Built build(const BuildingFeature& building, const Vec2d& ground = {0, 0}) {
  const LocalFrame frame({52, 13, 0});
  const BlockFrame block = block_frame(frame, ground);
  Built built;
  append_building(built.mesh, {frame, block}, building, built.issues);
  return built;
}

BuildingFeature house(Polygon footprint, RoofShape roof, double height = 9, double roof_height = 3) {
  BuildingFeature b;
  b.where = "way 1";
  b.footprint = std::move(footprint);
  b.height = height;
  b.roof_height = roof == RoofShape::flat ? 0 : roof_height;
  b.levels = 2;
  b.roof = roof;
  return b;
}

/// Checks the mesh as a closed body over its footprint; returns its volume.
double closed_volume(const BuildingFeature& building, Built built) {
  INFO(building.where << ", roof " << int(building.roof));
  CHECK(fault(built.mesh) == "");
  bool mended = false;
  if (building.min_height <= 0) add_bottom(built.mesh, Geos().valid_polygons(building.footprint, mended), 0);
  CHECK(open_edges(built.mesh, kWeld) == 0);
  return volume(built.mesh);
}

const Polygon kLShape{{{0, 0}, {20, 0}, {20, 8}, {9, 8}, {9, 18}, {0, 18}}, {}};
const Polygon kCourt{{{0, 0}, {30, 0}, {30, 24}, {0, 24}}, {{{8, 8}, {22, 8}, {22, 16}, {8, 16}}}};

}  // namespace

TEST_CASE("a flat roof encloses footprint times height") {
  for (const Polygon& p : {rectangle(0, 0, 12, 8), kLShape, kCourt}) {
    const BuildingFeature b = house(p, RoofShape::flat);
    CHECK(closed_volume(b, build(b)) == Approx(plan::area(p) * 9).epsilon(1e-3));
  }
}

TEST_CASE("roofs over a rectangle enclose their textbook volumes") {
  const double base = 12 * 8 * 6, roof = 12 * 8 * 3;
  const std::pair<RoofShape, double> cases[] = {
      {RoofShape::gabled, roof / 2.0},
      {RoofShape::hipped, 3.0 * 8 / 6 * (2 * 12 + 4)},  // wedge: h b / 6 (2 a + ridge), ridge = 12 - 8
      {RoofShape::pyramidal, roof / 3.0},
      {RoofShape::skillion, roof / 2.0},
  };
  for (const auto& [shape, above] : cases)
    for (const double angle : {0.0, 0.3, 1.2, 2.9}) {
      const BuildingFeature b = house({turned(rectangle(0, 0, 12, 8).outer, angle), {}}, shape);
      CHECK(closed_volume(b, build(b)) == Approx(base + above).epsilon(1e-3));
    }
}

TEST_CASE("a rectangle's roofs need no more triangles than their shape") {
  const auto triangles = [](RoofShape shape) {
    return build(house(rectangle(0, 0, 12, 8), shape)).mesh.indices.size() / 3;
  };
  CHECK(triangles(RoofShape::flat) == 8 + 2);
  CHECK(triangles(RoofShape::gabled) == 8 + 2 + 4);  // walls, two gables, two slopes
  CHECK(triangles(RoofShape::hipped) == 8 + 6);
  CHECK(triangles(RoofShape::pyramidal) == 8 + 4);
  CHECK(triangles(RoofShape::skillion) == 8 + 2 + 2 + 2);
}

TEST_CASE("every roof closes over every outline, either way round") {
  std::vector<Polygon> outlines{rectangle(0, 0, 12, 8), kLShape, kCourt, {turned(kLShape.outer, 0.7), {}}};
  outlines.push_back({{{0, 0}, {10, 1}, {8, 9}, {1, 7}}, {}});
  outlines.push_back({{{0, 0}, {30, 0}, {30, 10}, {20, 10}, {20, 4}, {10, 4}, {10, 10}, {0, 10}}, {}});
  for (Polygon p : outlines)
    for (const RoofShape shape : kShapes) {
      const BuildingFeature b = house(p, shape);
      const double inside = closed_volume(b, build(b)), ground = plan::area(p);
      CHECK(inside >= ground * 6 * (1 - 1e-3));
      CHECK(inside <= ground * 9 * (1 + 1e-3));
      std::reverse(p.outer.begin(), p.outer.end());
      for (auto& hole : p.holes) std::reverse(hole.begin(), hole.end());
      const BuildingFeature mirrored = house(p, shape);
      CHECK(closed_volume(mirrored, build(mirrored)) == Approx(inside).epsilon(1e-5));
    }
}

TEST_CASE("random outlines close, near and far, with holes and without") {
  const std::uint64_t seed = 20091;
  INFO("seed " << seed);
  Random random{seed};
  for (int i = 0; i < 300; ++i) {
    const Vec2d center = i % 3 == 0 ? Vec2d{1e5, -7e4} : Vec2d{random.between(-500, 500), random.between(-500, 500)};
    Polygon p{star(random, center, random.whole(3, 24), 6, 25), {}};
    if (p.outer.size() >= 8 && random.unit() < 0.4) p.holes.push_back(star(random, center, random.whole(3, 9), 1, 3));
    BuildingFeature b = house(p, kShapes[random.whole(0, 5)], 14, random.between(1, 9));
    b.where = "random " + std::to_string(i);
    b.min_height = random.unit() < 0.5 ? 0 : 2;
    Built built = build(b, center);
    INFO(b.where << ", " << p.outer.size() << " corners, roof " << int(b.roof));
    CHECK(fault(built.mesh) == "");
    if (b.min_height > 0) {  // it has a floor of its own; below, frames differ from the plan by the Earth's curvature
      CHECK(open_edges(built.mesh, kWeld) == 0);
      const double ground = plan::area(p), body = b.height - b.min_height;
      CHECK(volume(built.mesh) <= ground * body * 1.002);
      CHECK(volume(built.mesh) >= ground * (body - b.roof_height) * 0.998);
    }
  }
}

TEST_CASE("domes bulge") {
  std::vector<Vec2d> ring;
  for (int i = 0; i < 24; ++i) ring.emplace_back(10 * std::cos(i * 0.2617993878), 10 * std::sin(i * 0.2617993878));
  const BuildingFeature b = house({ring, {}}, RoofShape::dome, 20, 10);
  const double base = plan::area(b.footprint) * 10, half_ball = 2.0 / 3 * std::numbers::pi * 1000;
  CHECK(closed_volume(b, build(b)) == Approx(base + half_ball).epsilon(0.03));
}

TEST_CASE("windows: whole bays and storeys, and short walls are blind") {
  BuildingFeature b = house({{{0, 0}, {12, 0}, {12, 8}, {1.5, 8}, {1.5, 6.5}, {0, 6.5}}, {}}, RoofShape::flat, 12);
  b.levels = 4;
  const Built built = build(b);
  int windows = 0, blind = 0;
  for (std::size_t i = 0; i + 3 < built.mesh.vertices.size(); i += 4) {
    const auto* v = &built.mesh.vertices[i];
    if (material(v[0]) != Material::wall) break;
    const double length = glm::distance(Vec2(v[0].position), Vec2(v[1].position));
    if (length < 1.6) {
      ++blind;
      for (int k = 0; k < 4; ++k) CHECK(v[k].uv == Vec2(0, 0));
      continue;
    }
    ++windows;
    CHECK(v[0].uv == Vec2(0, 0));
    CHECK(v[2].uv == Vec2(std::round(length / 3), 4));
    CHECK(v[0].position.z == Approx(0).margin(1e-4));
    CHECK(v[2].position.z == Approx(12));
    // u grows to the right of someone who looks at the wall from outside
    const Vec3 normal = unpack_normal(v[0].normal), right = glm::cross(Vec3(0, 0, 1), normal);
    CHECK(glm::dot(v[1].position - v[0].position, right) == Approx(length));
  }
  CHECK(windows == 4);
  CHECK(blind == 2);
}

TEST_CASE("a courtyard's walls look into the courtyard") {
  const Built built = build(house(kCourt, RoofShape::flat));
  int inner = 0;
  for (const CityVertex& v : built.mesh.vertices) {
    if (material(v) != Material::wall) continue;
    const Vec3 n = unpack_normal(v.normal);
    const bool of_court = v.position.x > 1 && v.position.x < 29 && v.position.y > 1 && v.position.y < 23;
    const float towards_middle = glm::dot(Vec2(15, 12) - Vec2(v.position), Vec2(n));
    CHECK((towards_middle > 0) == of_court);
    inner += of_court;
  }
  CHECK(inner == 16);
}

TEST_CASE("a raised body has a floor, its windows begin there") {
  BuildingFeature b = house(rectangle(0, 0, 10, 10), RoofShape::flat, 12);
  b.min_height = 4;
  const Built built = build(b);
  CHECK(open_edges(built.mesh, kWeld) == 0);
  CHECK(volume(built.mesh) == Approx(800).epsilon(1e-3));
}

TEST_CASE("a roof that has no height gets one from its span, and leaves a storey") {
  const Polygon wide = rectangle(0, 0, 40, 30);
  CHECK(default_roof_height(RoofShape::gabled, rectangle(0, 0, 12, 8), 9) == Approx(2.8));
  CHECK(default_roof_height(RoofShape::gabled, wide, 9) == Approx(5.4));
  CHECK(default_roof_height(RoofShape::dome, wide, 5) == Approx(2.5));
  CHECK(default_roof_height(RoofShape::flat, wide, 5) == 0);
  for (double body = 0.1; body < 40; body += 0.37)
    for (const RoofShape shape : kShapes) {
      const double h = default_roof_height(shape, wide, body);
      CHECK(h <= 0.6 * body);
      CHECK(h >= 0);
      if (body > 3.2) CHECK(body - h >= 2.5 - 1e-9);
    }
  const Built built = build(house(rectangle(0, 0, 12, 8), RoofShape::gabled, 9, 0));
  float top = 0;
  for (const CityVertex& v : built.mesh.vertices)
    if (v.uv.y > 1.5F && material(v) == Material::wall) top = std::max(top, v.position.z);
  CHECK(top == Approx(6.2));  // eaves
}

TEST_CASE("bad outlines are told, and mended or left out") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto issues_of = [](Polygon p) { return build(house(std::move(p), RoofShape::gabled)); };
  for (const Polygon& p : {Polygon{}, Polygon{{{0, 0}, {1, 1}}, {}}, Polygon{{{0, 0}, {5, 5}, {10, 10}}, {}},
                           Polygon{{{3, 3}, {3, 3}, {3, 3}, {3, 3}}, {}}, Polygon{{{0, 0}, {nan, 1}, {5, 5}}, {}},
                           Polygon{{{0, 0}, {1e-3, 0}, {1e-3, 1e-3}}, {}}}) {
    const Built built = issues_of(p);
    CHECK(built.issues.size() == 1);
    CHECK(built.mesh.vertices.empty());
    CHECK(built.mesh.indices.empty());
  }
  const Built bow_tie = issues_of({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}});
  CHECK(bow_tie.issues.size() == 1);
  CHECK(fault(bow_tie.mesh) == "");
  CHECK(area(bow_tie.mesh, Material::roof) > 50);
  BuildingFeature sunk = house(rectangle(0, 0, 5, 5), RoofShape::flat, 3);
  sunk.min_height = 3;
  CHECK(build(sunk).issues.size() == 1);
  sunk.min_height = nan;
  CHECK(build(sunk).issues.size() == 1);
}

TEST_CASE("random nonsense never breaks the walls") {
  const std::uint64_t seed = 77;
  INFO("seed " << seed);
  Random random{seed};
  for (int i = 0; i < 500; ++i) {
    Polygon p;
    const double size = std::pow(10.0, random.between(-2, 3));
    for (int k = random.whole(3, 12); k > 0; --k)
      p.outer.emplace_back(random.between(0, size), random.between(0, size * (i % 5 == 0 ? 1e-3 : 1)));
    const BuildingFeature b = house(p, kShapes[random.whole(0, 5)], random.between(0, 30), random.between(0, 12));
    const Built built = build(b);
    INFO("case " << i << ", roof " << int(b.roof) << ", size " << size);
    CHECK(fault(built.mesh) == "");
    CHECK((!built.mesh.indices.empty() || !built.issues.empty()));
  }
}

TEST_CASE("buildings keep their shape in a block far from the anchor") {
  const Vec2d far{40000, -25000};
  Polygon p = rectangle(far.x, far.y, 12, 8);
  BuildingFeature b = house(p, RoofShape::gabled);
  b.min_height = 1;  // so that it has a floor
  const Built built = build(b, far);
  CHECK(fault(built.mesh) == "");
  CHECK(open_edges(built.mesh, kWeld) == 0);
  CHECK(volume(built.mesh) == Approx(12 * 8 * 5 + 12 * 8 * 1.5).epsilon(1e-3));
  for (const CityVertex& v : built.mesh.vertices) CHECK(std::abs(v.position.z - 1) < 8.1F);
}

TEST_CASE("a city of houses is quick", "[timing]") {
  Random random{5};
  std::vector<BuildingFeature> city;
  for (int i = 0; i < 1400; ++i)
    city.push_back(house({star(random, {i % 40 * 50.0, i / 40 * 50.0}, random.whole(4, 14), 8, 20), {}},
                         kShapes[random.whole(0, 5)]));
  const auto start = std::chrono::steady_clock::now();
  std::size_t triangles = 0;
  for (const BuildingFeature& b : city) triangles += build(b).mesh.indices.size() / 3;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  WARN(city.size() << " buildings, " << triangles << " triangles, " << seconds << " s");
  CHECK(seconds < 5);  // a guard against the quadratic, not a measurement
}
