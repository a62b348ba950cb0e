#include "apps/culling_benchmark/paper_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/culling_benchmark/paper_colour.h"
#include "culling/hash.h"
#include "scenegraph/draw/car_model.h"

namespace manzana::paper {
namespace {

using baselines::ObjectKind;
using culling::BoxD;

/// A mesh within a box, whose corners are given as shares of the box.
class Shape {
 public:
  explicit Shape(const BoxD& box) : box_(box) {}

  void triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3& colour) {
    const Vec3d size = box_.max - box_.min;
    const Vec3 shaded = colour * light(Vec3(glm::cross((b - a) * size, (c - a) * size)));
    for (const Vec3d& share : {a, b, c}) {
      const auto foot = static_cast<float>(0.8 + 0.2 * share.z);  // darker near the ground
      mesh_.indices.push_back(static_cast<std::uint32_t>(mesh_.corners.size()));
      mesh_.corners.push_back({Vec3(glm::mix(box_.min, box_.max, share)), pack(shaded * foot)});
    }
  }

  void quad(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d, const Vec3& colour) {
    triangle(a, b, c, colour);
    triangle(a, c, d, colour);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  BoxD box_;
  Mesh mesh_;
};

/// Four walls between two heights on the rectangle [low, high].
void add_walls(Shape& shape, const Vec2d& low, const Vec2d& high, double from, double to, const Vec3& colour) {
  const std::array<Vec2d, 5> ring{low, {high.x, low.y}, high, {low.x, high.y}, low};
  for (std::size_t i = 0; i < 4; ++i)
    shape.quad({ring[i], from}, {ring[i + 1], from}, {ring[i + 1], to}, {ring[i], to}, colour);
}

/// A hipped roof, its ridge along x.
void add_roof(Shape& shape, const Vec2d& low, const Vec2d& high, double eaves, const Vec3& colour) {
  const Vec3d a{low, eaves}, b{high.x, low.y, eaves}, c{high, eaves}, d{low.x, high.y, eaves};
  const Vec2d middle = (low + high) / 2.0;
  const Vec3d e{0.7 * low.x + 0.3 * high.x, middle.y, 1}, f{0.3 * low.x + 0.7 * high.x, middle.y, 1};
  shape.quad(a, b, f, e, colour);
  shape.quad(c, d, e, f, colour);
  shape.triangle(b, c, f, colour);
  shape.triangle(d, a, e, colour);
}

/// Houses have hipped roofs, towers flat ones. A little smaller than the box, each by its own share, so that no two
/// walls of neighbours lie in one plane, where the order of drawing would show.
Mesh building(const BoxD& box, std::uint64_t seed) {
  constexpr double kTower = 45;
  const auto gap = [&](std::uint64_t i) { return 0.02 * hash_unit(seed, i); };
  const Vec2d low{gap(0), gap(1)}, high{1 - gap(2), 1 - gap(3)};
  const bool tower = box.max.z - box.min.z > kTower;
  const double eaves = tower ? 1 - gap(4) : 0.72 + 0.1 * hash_unit(seed, 4);
  Shape shape(box);
  if (tower)
    shape.quad({low, eaves}, {high.x, low.y, eaves}, {high, eaves}, {low.x, high.y, eaves}, roof_colour(seed));
  else
    add_roof(shape, low, high, eaves, roof_colour(seed));
  add_walls(shape, low, high, 0, eaves, wall_colour(seed));
  return shape.take();
}

/// Two pyramids foot to foot, on a trunk.
Mesh tree(const BoxD& box, std::uint64_t seed) {
  constexpr std::size_t kSides = 8;
  constexpr double kCrown = 0.25, kWidest = 0.5;
  const Vec3d top{0.5, 0.5, 1}, bottom{0.5, 0.5, kCrown};
  const auto rim = [](std::size_t i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i % kSides) / kSides;
    return Vec3d(0.5 + 0.499 * std::cos(angle), 0.5 + 0.499 * std::sin(angle), kWidest);
  };
  Shape shape(box);
  for (std::size_t i = 0; i < kSides; ++i) {
    shape.triangle(rim(i), rim(i + 1), top, leaf_colour(seed));
    shape.triangle(rim(i + 1), rim(i), bottom, leaf_colour(seed));
  }
  add_walls(shape, Vec2d(0.46), Vec2d(0.54), 0, kWidest, kBark);
  return shape.take();
}

/// Halves a triangle at the middle m of its longest edge ab: abc becomes amc, and mbc is new.
void halve(Mesh& mesh, std::size_t triangle) {
  std::uint32_t* const corner = mesh.indices.data() + 3 * triangle;
  const auto length = [&](std::size_t i) {
    const Vec3 edge = mesh.corners[corner[(i + 1) % 3]].position - mesh.corners[corner[i]].position;
    return glm::dot(edge, edge);
  };
  std::size_t i = length(1) > length(0) ? 1 : 0;
  i = length(2) > length(i) ? 2 : i;
  const std::uint32_t a = corner[i], b = corner[(i + 1) % 3], c = corner[(i + 2) % 3];
  const auto m = static_cast<std::uint32_t>(mesh.corners.size());
  corner[(i + 1) % 3] = m;
  mesh.corners.push_back({(mesh.corners[a].position + mesh.corners[b].position) / 2.0F,
                          mean(mesh.corners[a].colour, mesh.corners[b].colour)});
  mesh.indices.insert(mesh.indices.end(), {m, b, c});
}

Mesh from_model(const draw::CarMesh& model) {
  Mesh mesh;
  for (const std::uint32_t index : model.indices) {
    const draw::CarVertex& vertex = model.vertices[index];
    const Corner corner{vertex.position, pack(part_colour(vertex.part) * light_on_car(vertex.normal))};
    const auto same = std::find_if(mesh.corners.begin(), mesh.corners.end(), [&](const Corner& c) {
      return c.position == corner.position && c.colour == corner.colour;
    });
    mesh.indices.push_back(static_cast<std::uint32_t>(same - mesh.corners.begin()));
    if (same == mesh.corners.end()) mesh.corners.push_back(corner);
  }
  return mesh;
}

}  // namespace

void refine(Mesh& mesh, std::size_t triangles) {
  mesh.indices.resize(3 * std::min(triangles, mesh.triangles()));
  mesh.indices.reserve(3 * triangles);
  for (std::size_t round = mesh.triangles(), next = 0; round > 0 && mesh.triangles() < triangles; ++next) {
    if (next == round) next = 0, round = mesh.triangles();
    halve(mesh, next);
  }
}

Mesh make_object(ObjectKind kind, const BoxD& box, std::size_t triangles, std::uint64_t seed) {
  if (triangles == 0) return {};
  if (kind == ObjectKind::car) return parked_car(make_car(triangles), box, seed);
  Mesh mesh = kind == ObjectKind::building ? building(box, seed) : tree(box, seed);
  refine(mesh, triangles);
  return mesh;
}

Mesh parked_car(Mesh car, const BoxD& box, std::uint64_t seed) {
  culling::Box own;
  for (const Corner& c : car.corners) own = {glm::min(own.min, c.position), glm::max(own.max, c.position)};
  const bool along_x = box.max.x - box.min.x > box.max.y - box.min.y;
  for (Corner& c : car.corners) {
    Vec3d share((c.position - own.min) / (own.max - own.min));
    if (along_x) share = {share.y, 1 - share.x, share.z};
    c.position = Vec3(glm::mix(box.min, box.max, share));
    c.colour = tinted(c.colour, paint(static_cast<std::uint32_t>(seed)));
  }
  return car;
}

Mesh make_car(std::size_t triangles) {
  Mesh car;
  for (std::size_t level = 0; level < draw::kCarLevels; ++level) {
    car = from_model(draw::make_car(draw::CarBody::saloon, level));
    if (car.triangles() <= triangles) break;
  }
  refine(car, triangles);
  return car;
}

}  // namespace manzana::paper
