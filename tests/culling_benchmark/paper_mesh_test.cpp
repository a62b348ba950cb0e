#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <set>

#include "apps/culling_benchmark/paper_geometry.h"
#include "culling/baselines/cases.h"
#include "culling/hash.h"

namespace manzana::paper {
namespace {

using baselines::ObjectKind;
using culling::BoxD;

BoxD made_box(std::uint64_t i) {
  const auto at = [i](std::uint64_t k, double low, double high) { return low + (high - low) * hash_unit(i, k); };
  const Vec3d low(at(0, -3000, 3000), at(1, -3000, 3000), at(2, -5, 5));
  return {low, low + Vec3d(at(3, 1.5, 40), at(4, 1.5, 40), at(5, 1, 100))};
}

bool within(const BoxD& box, const Mesh& mesh) {
  const culling::Box outward = culling::narrow(box, Vec3d(0));
  return std::all_of(mesh.corners.begin(), mesh.corners.end(), [&](const Corner& c) {
    return glm::all(glm::lessThanEqual(outward.min, c.position)) &&
           glm::all(glm::lessThanEqual(c.position, outward.max));
  });
}

std::array<Vec3d, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
  std::array<Vec3d, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = Vec3d(mesh.corners.at(mesh.indices.at(3 * triangle + k)).position);
  return p;
}

double area(const std::array<Vec3d, 3>& p) { return glm::length(glm::cross(p[1] - p[0], p[2] - p[0])) / 2; }

double area(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) sum += area(corners_of(mesh, t));
  return sum;
}

/// Area as a share of the longest edge's square, of the thinnest triangle; 0: one is degenerate.
double thinnest(const Mesh& mesh) {
  double least = 1;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const auto p = corners_of(mesh, t);
    const double longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    least = std::min(least, area(p) / (longest * longest));
  }
  return least;
}

/// The car's thinnest triangle has ten times as much, in a box of 1 : 60 still twice; what has collapsed has 1e-7.
constexpr double kThin = 2e-5;

using Triangle = std::array<float, 9>;
std::vector<Triangle> sorted_triangles(const Geometry& geometry) {
  std::vector<Triangle> all(geometry.indices.size() / 3);
  for (std::size_t i = 0; i < geometry.indices.size(); ++i) {
    const Vec3 p = geometry.corners.at(geometry.indices[i]).position;
    for (int axis = 0; axis < 3; ++axis) all[i / 3][3 * (i % 3) + static_cast<std::size_t>(axis)] = p[axis];
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

TEST_CASE("a mesh has exactly as many triangles as asked for, all in its box, none degenerate") {
  for (const ObjectKind kind : {ObjectKind::building, ObjectKind::tree, ObjectKind::car}) {
    for (const std::size_t n : {0, 1, 2, 13, 14, 15, 18, 50, 387, 640, 1701, 5000}) {
      for (std::uint64_t i = 0; i < 8; ++i) {
        INFO("kind " << static_cast<int>(kind) << ", " << n << " triangles, box " << i);
        const BoxD box = made_box(i);
        const Mesh mesh = make_object(kind, box, n, i);
        REQUIRE(mesh.triangles() == n);
        CHECK(within(box, mesh));
        CHECK(thinnest(mesh) > kThin);
      }
    }
  }
}

TEST_CASE("refining a mesh leaves its surface as it is") {
  for (const ObjectKind kind : {ObjectKind::building, ObjectKind::tree}) {
    const Mesh coarse = make_object(kind, made_box(3), 24, 3), fine = make_object(kind, made_box(3), 3000, 3);
    CHECK(area(fine) == Approx(area(coarse)).epsilon(1e-4));
    CHECK(area(make_object(kind, made_box(3), 9, 3)) < area(coarse));  // fewer than show the whole shape
  }
}

TEST_CASE("the paper's cars have their triangles, stand on their wheels and are as long as a car") {
  for (const std::size_t n : {1701, 511, 387, 262, 50, 18}) {
    INFO(n << " triangles");
    const Mesh car = make_car(n);
    CHECK(car.triangles() == n);
    CHECK(within({Vec3d(-1, -2.3, -0.001), Vec3d(1, 2.3, 1.5)}, car));
    CHECK(area(car) > 15);
    CHECK(thinnest(car) > kThin);
  }
}

TEST_CASE("the geometry of C1 has all of its triangles, whatever its order") {
  const baselines::City city = baselines::make_city(*baselines::find_case("C1"), 1);
  const Geometry rows = make_geometry(city);
  REQUIRE(rows.objects() == city.objects());
  CHECK(rows.indices.size() == 3 * 367'000);
  for (std::uint32_t row = 0; row < city.objects(); ++row)
    CHECK(rows.first_index[row + 1] - rows.first_index[row] == 3 * city.triangles[row]);

  std::vector<std::uint32_t> order(city.objects());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [](std::uint32_t a, std::uint32_t b) { return hash_bits(9, a) < hash_bits(9, b); });
  const Geometry own = arranged(rows, order);
  for (std::uint32_t i = 0; i < city.objects(); ++i)
    CHECK(own.first_index[i + 1] - own.first_index[i] == 3 * city.triangles[order[i]]);
  CHECK(sorted_triangles(own) == sorted_triangles(rows));
}

}  // namespace manzana::paper
