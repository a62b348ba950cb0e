#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "scenegraph/import/plan_geometry.h"
#include "scenegraph/import/surface_piece.h"
#include "tests/import/meshes/mesh_checks.h"

using namespace checks;

namespace {

struct Laid {
  std::vector<Issue> issues;
  std::vector<SurfacePiece> pieces;
  explicit Laid(const std::vector<AreaFeature>& areas) : pieces(area_pieces(areas, issues)) {}
  double area(Material kind) const {
    double sum = 0;
    for (const SurfacePiece& p : pieces) sum += checks::area(p.plan, kind);
    return sum;
  }
};

AreaFeature green(Polygon shape, Material kind = Material::grass) {
  AreaFeature a;
  a.where = "way 5";
  a.shape = std::move(shape);
  a.kind = kind;
  return a;
}

}  // namespace

TEST_CASE("areas are covered once, in pieces of bounded size") {
  const std::uint64_t seed = 31;
  INFO("seed " << seed);
  Random random{seed};
  for (int i = 0; i < 60; ++i) {
    const Vec2d center = i % 2 == 0 ? Vec2d{1e5, 2e5} : Vec2d{0, 0};
    const double size = random.between(5, 900);
    Polygon p{star(random, center, random.whole(6, 200), size * 0.6, size), {}};
    for (int k = random.whole(0, 3); k > 0; --k) {
      const Vec2d at = center + size * 0.25 * Vec2d{k == 1, k == 2};
      p.holes.push_back(star(random, at, random.whole(3, 9), size * 0.02, size * 0.08));
    }
    const Laid laid({green(p, Material::wood)});
    CHECK(laid.issues.empty());
    CHECK(laid.area(Material::wood) == Approx(plan::area(p)).epsilon(1e-3));
    for (const SurfacePiece& piece : laid.pieces) {
      CHECK(fault(piece.plan) == "");
      for (const CityVertex& v : piece.plan.vertices) {
        CHECK(double(std::max(std::abs(v.position.x), std::abs(v.position.y))) <= kSurfacePiece + 0.01);
        CHECK(v.position.z == Approx(area_height(Material::wood)));
      }
    }
  }
}

TEST_CASE("a plain area is two triangles, and its uv are metres") {
  const Laid laid({green(rectangle(7, 9, 100, 60))});
  REQUIRE(laid.pieces.size() == 1);
  CHECK(laid.pieces[0].center == Vec2d(57, 39));
  const CityMesh& mesh = laid.pieces[0].plan;
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.indices.size() == 6);
  for (const CityVertex& v : mesh.vertices) {
    CHECK(v.uv.x == Approx(Vec3d(v.position).x + 57).margin(1e-4));
    CHECK(v.uv.y == Approx(Vec3d(v.position).y + 39).margin(1e-4));
  }
}

TEST_CASE("areas lie in a fixed order, below the paths") {
  const Material order[] = {Material::wood, Material::farmland, Material::grass,   Material::park,
                            Material::sand, Material::water,    Material::pavement};
  for (std::size_t i = 1; i < std::size(order); ++i) CHECK(area_height(order[i]) > area_height(order[i - 1]) + 0.003);
  CHECK(area_height(Material::wood) >= 0.02);
  CHECK(area_height(Material::pavement) <= 0.05 + 1e-9);
}

TEST_CASE("bad areas are mended or told") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Laid bow_tie({green({{{0, 0}, {100, 100}, {100, 0}, {0, 100}}, {}})});
  CHECK(bow_tie.issues.size() == 1);
  CHECK(bow_tie.area(Material::grass) == Approx(5000));
  const Laid none({green({}), green({{{0, 0}, {1, 1}}, {}}), green({{{0, 0}, {nan, 1}, {4, 4}}, {}}),
                   green({{{0, 0}, {1e9, 0}, {0, 1e9}}, {}}), green({{{0, 0}, {5, 5}, {10, 10}}, {}})});
  CHECK(none.issues.size() == 5);
  CHECK(none.pieces.empty());
}

TEST_CASE("an ocean is cut into a bounded number of pieces") {
  const Laid laid({green(rectangle(-4e6, -4e6, 8e6, 8e6), Material::water)});
  CHECK(laid.pieces.size() == std::size_t{kMostCells} * kMostCells);
}
