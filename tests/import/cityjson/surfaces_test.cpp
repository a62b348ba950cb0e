// Triangles of surfaces in space, against measures that their maker does not share.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "tests/import/cityjson/made.h"
#include "tests/import/meshes/mesh_checks.h"
#include "tests/support/data.h"

using namespace manzana;
using checks::Random;

namespace {

const LocalFrame kFrame({52, 4, 0});

struct Laid {
  CityMesh mesh;
  std::vector<Issue> issues;
};
Laid laid(const ConstructionFeature& work, const LocalFrame& frame = kFrame) {
  Laid result;
  const BlockFrame block = block_frame(frame, Vec2d(work.points[0]));
  append_construction(result.mesh, {frame, block}, work, result.issues);
  return result;
}

double area(const CityMesh& mesh) {
  double sum = 0;
  for (const Material kind : {Material::wall, Material::roof, Material::concrete}) sum += checks::area(mesh, kind);
  return sum;
}

void add_face(ConstructionFeature& work, const std::vector<std::vector<Vec3d>>& rings) {
  for (const auto& ring : rings) {
    for (const Vec3d& p : ring) {
      const auto known = std::ranges::find(work.points, p);
      work.corners.push_back(static_cast<std::uint32_t>(known - work.points.begin()));
      if (known == work.points.end()) work.points.push_back(p);
    }
    work.ring_last.push_back(static_cast<std::uint32_t>(work.corners.size()));
  }
  work.faces.push_back({.last_ring = static_cast<std::uint32_t>(work.ring_last.size())});
}
void close_part(ConstructionFeature& work) { work.part_last.push_back(static_cast<std::uint32_t>(work.faces.size())); }

std::vector<Vec3d> raised(const std::vector<Vec2d>& ring, double z) {
  std::vector<Vec3d> result;
  for (const Vec2d& p : ring) result.emplace_back(p, z);
  return result;
}

/// A star with a star-shaped court, standing from 0 to `height`, outward.
ConstructionFeature prism(Random& random, double height, bool inward) {
  const std::vector<Vec2d> outer = checks::star(random, {30, -20}, random.whole(8, 30), 8, 15);
  const std::vector<Vec2d> court = checks::star(random, {30, -20}, random.whole(3, 12), 2, 6);
  ConstructionFeature work;
  const auto add = [&](std::vector<std::vector<Vec3d>> rings) {
    for (auto& ring : rings)
      if (inward) std::ranges::reverse(ring);
    add_face(work, rings);
  };
  const auto backward = [](std::vector<Vec3d> ring) { return std::ranges::reverse(ring), ring; };
  add({raised(outer, height), backward(raised(court, height))});
  add({backward(raised(outer, 0)), raised(court, 0)});
  const auto walls = [&](const std::vector<Vec2d>& ring, bool out) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Vec2d a = ring[i], b = ring[(i + 1) % ring.size()];
      if (!out) std::swap(a, b);
      add({{Vec3d(a, 0), Vec3d(b, 0), Vec3d(b, height), Vec3d(a, height)}});
    }
  };
  walls(outer, true);
  walls(court, false);
  close_part(work);
  return work;
}

/// By the divergence theorem on the polygons themselves.
double volume_of(const ConstructionFeature& work) {
  double six = 0;
  std::uint32_t corner = 0;
  for (const std::uint32_t last : work.ring_last) {
    const Vec3d origin = work.points[0], o = work.points[work.corners[corner]] - origin;
    Vec3d twice(0);
    for (std::uint32_t i = corner + 2; i < last; ++i)
      twice += glm::cross(work.points[work.corners[i - 1]] - origin - o, work.points[work.corners[i]] - origin - o);
    six += glm::dot(o, twice);
    corner = last;
  }
  return six / 6;
}

/// Every edge of a ring goes as often one way as the other.
bool closed_in_file(const ConstructionFeature& work) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  std::uint32_t first = 0;
  for (const std::uint32_t last : work.ring_last) {
    for (std::uint32_t i = first; i < last; ++i) {
      const std::uint32_t a = work.corners[i], b = work.corners[i + 1 == last ? first : i + 1];
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
    first = last;
  }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

double surface_of(const ConstructionFeature& work) {
  double sum = 0;
  std::uint32_t corner = 0;
  for (std::uint32_t ring = 0, face = 0; face < work.faces.size(); ++face)
    for (bool outer = true; ring < work.faces[face].last_ring; ++ring, outer = false) {
      Vec3d twice(0);
      const Vec3d& o = work.points[work.corners[corner]];
      for (std::uint32_t i = corner + 2; i < work.ring_last[ring]; ++i)
        twice += glm::cross(work.points[work.corners[i - 1]] - o, work.points[work.corners[i]] - o);
      sum += (outer ? 0.5 : -0.5) * glm::length(twice);
      corner = work.ring_last[ring];
    }
  return sum;
}

}  // namespace

TEST_CASE("solids with courts stay watertight and keep volume and area whichever way they are wound") {
  Random random{7};
  for (int round = 0; round < 60; ++round) {
    const double height = random.between(2, 40);
    const ConstructionFeature work = prism(random, height, round % 2 == 1);
    const Laid result = laid(work);
    CAPTURE(round, result.issues.size());
    REQUIRE(checks::fault(result.mesh) == "");
    CHECK(result.issues.empty());
    CHECK(checks::open_edges(result.mesh, 1e-4) == 0);
    CHECK(checks::volume(result.mesh) == Approx(std::abs(volume_of(work))).epsilon(1e-3));
    CHECK(area(result.mesh) == Approx(surface_of(work)).epsilon(1e-3));
  }
}

TEST_CASE("a face anywhere in space keeps its area and is seen from both sides") {
  Random random{11};
  for (int round = 0; round < 100; ++round) {
    const Vec3d u = glm::normalize(Vec3d(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) + 0.01);
    const Vec3d w = glm::normalize(glm::cross(u, Vec3d(0.3, 0.5, -0.8)));
    const Vec3d v = glm::cross(w, u);
    const auto placed = [&](const std::vector<Vec2d>& ring) {
      std::vector<Vec3d> result;
      for (const Vec2d& p : ring) result.push_back(Vec3d(5, 5, 40) + u * p.x + v * p.y);
      return result;
    };
    ConstructionFeature work;
    add_face(work, {placed(checks::star(random, {0, 0}, random.whole(8, 40), 8, 20)),
                    placed(checks::star(random, {0, 0}, random.whole(3, 9), 1, 5))});
    close_part(work);
    const Laid result = laid(work);
    CAPTURE(round);
    REQUIRE(checks::fault(result.mesh) == "");
    CHECK(area(result.mesh) == Approx(2 * surface_of(work)).epsilon(1e-3));
  }
}

TEST_CASE("points on an edge that another face has stay in the triangles") {
  ConstructionFeature work;  // a box whose one wall is in two, so that the roof has a corner on a straight edge
  add_face(work, {{{0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {2, 4, 3}, {0, 4, 3}}});
  add_face(work, {{{0, 4, 0}, {2, 4, 0}, {4, 4, 0}, {4, 0, 0}, {0, 0, 0}}});
  add_face(work, {{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}});
  add_face(work, {{{4, 0, 0}, {4, 4, 0}, {4, 4, 3}, {4, 0, 3}}});
  add_face(work, {{{4, 4, 0}, {2, 4, 0}, {2, 4, 3}, {4, 4, 3}}});
  add_face(work, {{{2, 4, 0}, {0, 4, 0}, {0, 4, 3}, {2, 4, 3}}});
  add_face(work, {{{0, 4, 0}, {0, 0, 0}, {0, 0, 3}, {0, 4, 3}}});
  close_part(work);
  const Laid result = laid(work);
  CHECK(checks::open_edges(result.mesh, 1e-4) == 0);
  CHECK(checks::volume(result.mesh) == Approx(48).epsilon(1e-3));
}

TEST_CASE("a face that crosses itself is mended and one without area is told") {
  ConstructionFeature work;
  work.where = "bow";
  add_face(work, {{{0, 0, 0}, {4, 0, 4}, {4, 0, 0}, {0, 0, 3}}});
  add_face(work, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
  close_part(work);
  const Laid result = laid(work);
  CHECK(area(result.mesh) > 1);
  REQUIRE(result.issues.size() == 2);
  CHECK(result.issues[0].what == "1 faces without area");
  CHECK(result.issues[1].what == "1 faces cross themselves; mended");
}

TEST_CASE("walls that are rectangles have whole bays and storeys") {
  const CityFeatures city = made::read(made::one_building());
  const Laid result = laid(city.constructions.at(0), city.frame);
  float bays = 0, storeys = 0;
  for (const CityVertex& v : result.mesh.vertices) {
    if (checks::material(v) != Material::wall) continue;
    CHECK(std::abs(v.uv.x - std::round(v.uv.x)) < 1e-3F);
    CHECK(std::abs(v.uv.y - std::round(v.uv.y)) < 1e-3F);
    bays = std::max(bays, v.uv.x), storeys = std::max(storeys, v.uv.y);
  }
  CHECK(std::round(bays) == 3);  // 10 m
  CHECK(std::round(storeys) == 2);
}

TEST_CASE("solids of real cities stay watertight and keep their volume") {
  for (const char* name : {"citymodel/delft-bgt.city.json", "citymodel/nl-topo3d.city.json", "tiny/small.city.jsonl",
                           "tiny/multi-lod.city.json", "tiny/denhaag-subset.city.json"}) {
    const auto file = data_file(name);
    if (!file) return;
    const CityFeatures city = read_cityjson(*file, {}, {});
    std::size_t closed = 0;
    for (const ConstructionFeature& work : city.constructions) {
      if (!work.where.starts_with("Building")) continue;
      const Laid result = laid(work, city.frame);
      CAPTURE(name, work.where);
      REQUIRE(checks::fault(result.mesh) == "");
      if (!closed_in_file(work)) continue;
      ++closed;
      CHECK(checks::open_edges(result.mesh, 2e-4) == 0);
      CHECK(checks::volume(result.mesh) == Approx(volume_of(work)).epsilon(0.01));
    }
    CAPTURE(name, closed);
    CHECK((closed > 0) == (std::string_view(name) != "citymodel/delft-bgt.city.json"));  // its solids have gaps
  }
}
