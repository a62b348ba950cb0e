// Levels of buildings by edge collapse: how far they are off, what they keep, and when there are any.
#include "scenegraph/import/building_levels.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numeric>

#include "scenegraph/import/edge_collapse.h"
#include "tests/import/cityjson/made.h"
#include "tests/support/data.h"
#include "tests/support/random.h"

using namespace manzana;

namespace {

using Height = std::function<double(double, double)>;

/// A level grid of n x n squares of a metre, coloured by `red` in the x below it.
CityMesh grid(int n, const Height& height, int red = 0) {
  CityMesh mesh;
  const auto normal = pack_normal({0, 0, 1});
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const std::uint32_t colour = pack_colour(x < red ? 0xff0000 : 0x808080, Material::roof);
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        const Vec3d p(x + i, y + j, height(x + i, y + j));
        mesh.vertices.push_back({Vec3(p), normal, colour, Vec2(3 * p.x + 1, 2 * p.y), 0});
      }
      for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + k);
    }
  return mesh;
}

/// A cube of n metres, its sides cut into squares of a metre.
CityMesh cube(int n) {
  CityMesh mesh;
  const double size = n;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      CityMesh side = grid(n, [](double, double) { return 0; });
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      Vec3 normal(0);
      normal[axis] = far ? 1 : -1;
      for (CityVertex& v : side.vertices) {
        Vec3 p(0);
        p[(axis + 1) % 3] = v.position.x, p[(axis + 2) % 3] = v.position.y,
                       p[axis] = far ? static_cast<float>(size) : 0;
        v.position = p, v.normal = pack_normal(normal);
        mesh.vertices.push_back(v);
      }
      for (std::size_t i = 0; i < side.indices.size(); i += 3)
        for (const std::size_t k : {0, far ? 1 : 2, far ? 2 : 1}) mesh.indices.push_back(first + side.indices[i + k]);
    }
  return mesh;
}

Vec3d at(const CityMesh& mesh, std::size_t i) { return Vec3d(mesh.vertices[mesh.indices[i]].position); }

double volume(const CityMesh& mesh) {
  double six = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    six += glm::dot(at(mesh, i), glm::cross(at(mesh, i + 1), at(mesh, i + 2)));
  return six / 6;
}

/// Of the triangles that `keep` likes.
template <class Keep>
double area(const CityMesh& mesh, Keep&& keep) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (keep(mesh.vertices[mesh.indices[i + 2]]))
      sum += glm::length(glm::cross(at(mesh, i + 1) - at(mesh, i), at(mesh, i + 2) - at(mesh, i))) / 2;
  return sum;
}

double distance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  // The nearest point by descending a fine subdivision would do; barycentric sampling is dumb and sure.
  constexpr int kSteps = 60;
  double nearest = 1e300;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      nearest = std::min(nearest, glm::distance(p, a * (1 - u - v) + b * u + c * v));
    }
  return nearest;
}
double distance(const Vec3d& p, const CityMesh& mesh) {
  double nearest = 1e300;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    nearest = std::min(nearest, distance(p, at(mesh, i), at(mesh, i + 1), at(mesh, i + 2)));
  return nearest;
}

/// Edges that do not pair, by places.
std::size_t open_edges(const CityMesh& mesh) {
  std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> balance;
  const auto key = [](const Vec3d& p) { return std::array{p.x, p.y, p.z}; };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = key(at(mesh, i + k)), b = key(at(mesh, i + (k + 1) % 3));
      a < b ? ++balance[{a, b}] : --balance[{b, a}];
    }
  return static_cast<std::size_t>(std::ranges::count_if(balance, [](const auto& e) { return e.second != 0; }));
}

}  // namespace

TEST_CASE("a cut up plane becomes two triangles and what lies on it goes on") {
  const CityMesh level = levels_of(grid(8, [](double, double) { return 0; }))[0];
  REQUIRE(level.indices.size() == 6);
  for (const CityVertex& v : level.vertices) {
    CHECK(v.uv.x == Approx(3 * v.position.x + 1));
    CHECK(v.uv.y == Approx(2 * v.position.y).margin(1e-5));
    CHECK(v.normal == pack_normal({0, 0, 1}));
  }
  CHECK(area(level, [](const CityVertex&) { return true; }) == Approx(64));
}

TEST_CASE("what wears a picture keeps its place on it and meets what wears another where it did") {
  constexpr int kSide = 8;
  CityMesh mesh = grid(kSide, [](double, double) { return 0; });
  const auto place = [](std::uint32_t texture, const Vec3& p) {
    return texture == 1 ? Vec2(p.x / 8, p.y / 8 + 0.1F) : Vec2(0.3F - p.y / 9, p.x / 7);
  };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const std::uint32_t texture = v / 4 % kSide < 3 ? 1 : 2;
    mesh.textures.push_back(texture);
    mesh.vertices[v].uv = place(texture, mesh.vertices[v].position);
    mesh.vertices[v].colour = pack_colour(static_cast<std::uint32_t>(v / 4), Material::wall);  // each part its own mean
  }
  const CityMesh level = levels_of(mesh)[0];
  CHECK(level.indices.size() == 12);
  REQUIRE(level.textures.size() == level.vertices.size());
  std::array<double, 3> areas{};
  for (std::size_t i = 0; i + 2 < level.indices.size(); i += 3) {
    const std::uint32_t texture = level.textures[level.indices[i]];
    areas.at(texture) += glm::length(glm::cross(at(level, i + 1) - at(level, i), at(level, i + 2) - at(level, i))) / 2;
    for (std::size_t k = i; k < i + 3; ++k) {
      CHECK(level.textures[level.indices[k]] == texture);
      const CityVertex& v = level.vertices[level.indices[k]];
      CHECK(glm::distance(v.uv, place(texture, v.position)) < 1e-5F);
    }
  }
  CHECK(areas[1] == Approx(24));
  CHECK(areas[2] == Approx(40));
}

TEST_CASE("where a picture is bent over a surface its corners stay") {
  CityMesh mesh = grid(8, [](double, double) { return 0; });
  for (CityVertex& v : mesh.vertices) v.uv = Vec2(v.position.x * v.position.x, v.position.y) / 64.0F;
  CHECK(levels_of(mesh)[0].indices.size() == 6);  // tiles may go on as they like
  mesh.textures.assign(mesh.vertices.size(), 1);
  for (const CityMesh& level : levels_of(mesh)) CHECK(level.indices.empty());
}

TEST_CASE("a cut up cube becomes twelve triangles that are closed and no more at coarser levels") {
  const CityMesh mesh = cube(5);
  REQUIRE(open_edges(mesh) == 0);
  const auto levels = levels_of(mesh);
  CHECK(levels[0].indices.size() == 36);
  CHECK(volume(levels[0]) == Approx(125));
  CHECK(open_edges(levels[0]) == 0);
  CHECK(levels[1].indices.empty());
  CHECK(levels[2].indices.empty());
  for (const CityMesh& of_plain : levels_of(levels[0])) CHECK(of_plain.indices.empty());
}

TEST_CASE("what is seen from both sides stays so") {
  CityMesh mesh = grid(8, [](double, double) { return 0; });
  const auto vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::vector<std::uint32_t> front = mesh.indices;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    CityVertex v = mesh.vertices[i];
    v.normal = pack_normal({0, 0, -1});
    mesh.vertices.push_back(v);
  }
  for (std::size_t i = 0; i < front.size(); i += 3)
    for (const std::size_t k : {0, 2, 1}) mesh.indices.push_back(vertices + front[i + k]);
  const CityMesh level = levels_of(mesh)[0];
  CHECK(level.indices.size() == 12);
  for (const float side : {1.0F, -1.0F})
    CHECK(area(level, [&](const CityVertex& v) { return v.normal == pack_normal({0, 0, side}); }) == Approx(64));
}

TEST_CASE("between colours the border stays where it is") {
  const CityMesh level = levels_of(grid(
      8, [](double, double) { return 0; }, 3))[0];
  CHECK(level.indices.size() == 12);
  CHECK(area(level, [](const CityVertex& v) { return (v.colour & 255U) == 255U; }) == Approx(24));
  CHECK(area(level, [](const CityVertex& v) { return (v.colour & 255U) != 255U; }) == Approx(40));
}

TEST_CASE("walls with windows of their own end where they did and their windows stay in place") {
  CityMesh mesh = grid(8, [](double, double) { return 0; });
  const auto uv = [](const Vec3& p, bool second) { return second ? Vec2(3 * p.x + 7, p.y) : Vec2(p.x, p.y); };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    CityVertex& v = mesh.vertices[i];
    v.colour = pack_colour(0x808080, Material::wall);
    v.uv = uv(v.position, i / 4 % 8 >= 3);
  }
  const CityMesh level = levels_of(mesh)[0];
  REQUIRE(level.indices.size() == 12);
  for (std::size_t i = 0; i < level.indices.size(); i += 3) {
    const bool second = std::max({at(level, i).x, at(level, i + 1).x, at(level, i + 2).x}) > 3;
    for (std::size_t k = i; k < i + 3; ++k) {
      const CityVertex& v = level.vertices[level.indices[k]];
      CHECK(v.uv.x == Approx(uv(v.position, second).x).margin(1e-5));
      CHECK(v.uv.y == Approx(v.position.y).margin(1e-5));
    }
  }
}

TEST_CASE("no point is farther from a level than its error and nothing of a level is far from the mesh") {
  support::Random random(7);
  for (int round = 0; round < 4; ++round) {
    std::map<std::pair<double, double>, double> bumps;
    const double rough = 0.05 * std::pow(3.0, round);
    const CityMesh mesh = grid(8, [&](double x, double y) {
      return bumps.try_emplace({x, y}, random.within(-rough, rough)).first->second;
    });
    const auto levels = levels_of(mesh);
    for (std::size_t l = 0; l < kMeshLevels; ++l) {
      if (levels[l].indices.empty()) continue;
      INFO("rough " << rough << ", level " << l << ": " << levels[l].indices.size() / 3 << " triangles");
      constexpr double kSampled = 0.1;  // the distance is measured to samples
      double worst = 0, back = 0;
      for (const CityVertex& v : mesh.vertices) worst = std::max(worst, distance(Vec3d(v.position), levels[l]));
      for (std::size_t i = 0; i + 2 < levels[l].indices.size(); i += 3)
        back = std::max(back, distance((at(levels[l], i) + at(levels[l], i + 1) + at(levels[l], i + 2)) / 3.0, mesh));
      CHECK(worst <= kMeshLevelErrors[l] + kSampled);
      CHECK(back <= 2 * kMeshLevelErrors[l] + kSampled);
      for (const CityVertex& v : levels[l].vertices)
        CHECK(std::ranges::any_of(mesh.vertices, [&](const CityVertex& w) { return w.position == v.position; }));
    }
    CHECK((levels[0].indices.empty() || rough < 0.2));
    CHECK(std::ranges::any_of(levels, [](const CityMesh& level) { return !level.indices.empty(); }));
  }
}

TEST_CASE("a level of a level is measured against the mesh that there was at first") {
  std::vector<Vec3d> points;
  std::vector<EdgeCollapse::Triangle> triangles;
  for (std::uint32_t i = 0; i <= 40; ++i)  // a quarter of a cylinder's wall, 20 m about
    for (const double z : {0.0, 5.0}) points.emplace_back(20 * std::cos(i * 0.04), 20 * std::sin(i * 0.04), z);
  for (std::uint32_t i = 0; i < 40; ++i) {
    triangles.push_back({{2 * i, 2 * i + 2, 2 * i + 1}});
    triangles.push_back({{2 * i + 1, 2 * i + 2, 2 * i + 3}});
  }
  EdgeCollapse collapse(points, triangles);
  std::size_t before = triangles.size();
  for (const double error : {0.05, 0.2, 0.8}) {
    collapse.run(error);
    CityMesh now;
    for (const EdgeCollapse::Triangle& t : collapse.triangles())
      for (std::size_t k = 0; t.alive && k < 3; ++k) {
        now.indices.push_back(static_cast<std::uint32_t>(now.vertices.size()));
        now.vertices.push_back({Vec3(points[t.corner[k]]), 0, 0, {}, 0});
      }
    const std::size_t left = now.indices.size() / 3;
    constexpr double kSampled = 0.1;
    for (const Vec3d& p : points) CHECK(distance(p, now) <= error + kSampled);
    CHECK(left < before);
    before = left;
  }
}

TEST_CASE("rounded surfaces stay as they are") {
  CityMesh mesh = grid(8, [](double, double) { return 0; });
  for (CityVertex& v : mesh.vertices)
    v.normal = pack_normal(glm::normalize(Vec3(0.01F * v.position.x, 0.01F * v.position.y, 1)));
  for (const CityMesh& level : levels_of(mesh)) CHECK(level.indices.empty());
}

TEST_CASE("triangles in any disorder give levels that are sound") {
  support::Random random(11);
  std::size_t levels = 0;
  for (int round = 0; round < 300; ++round) {
    CityMesh mesh;  // on few places, so that edges have many triangles, triangles are there twice, or are lines
    const auto at_random = [&] { return static_cast<float>(random.below(3)) * (round % 2 == 0 ? 1.0F : 0.05F); };
    for (std::uint32_t i = 0; i < 120; ++i) {
      const Vec3 normal = random.below(2) == 0 ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
      mesh.vertices.push_back({Vec3(at_random(), at_random(), at_random()), pack_normal(normal),
                               pack_colour(random.below(2) == 0 ? 0xff0000 : 0x808080, Material::wall),
                               Vec2(at_random(), at_random()), 0});
      mesh.vertices.back().normal = mesh.vertices[i - i % 3].normal;  // flat
      mesh.indices.push_back(i);
    }
    for (const CityMesh& level : levels_of(mesh)) {
      CHECK(level.indices.size() <= 0.7 * static_cast<double>(mesh.indices.size()));
      for (const std::uint32_t i : level.indices) REQUIRE(i < level.vertices.size());
      for (const CityVertex& v : level.vertices) {
        REQUIRE(std::ranges::any_of(mesh.vertices, [&](const CityVertex& w) { return w.position == v.position; }));
        REQUIRE((std::isfinite(v.uv.x) && std::isfinite(v.uv.y)));
      }
      levels += level.indices.empty() ? 0 : 1;
    }
  }
  CHECK(levels > 10);
}

TEST_CASE("Delft has fewer triangles at each level") {
  const auto file = data_file("citymodel/delft-bgt.city.json");
  if (!file) return;
  const Imported city = import_city(file->string(), {}, {});
  const MeshLayer& layer = city.scene.buildings;
  std::vector<std::size_t> triangles{layer.mesh.indices.size() / 3};
  std::vector<std::uint32_t> drawn(layer.table.size());
  for (std::uint32_t row = 0; row < drawn.size(); ++row)
    drawn[row] = layer.index_first[row + 1] - layer.index_first[row];
  for (const MeshRows& level : layer.levels) {
    REQUIRE(level.index_first.size() == layer.table.size() + 1);
    for (std::uint32_t row = 0; row < drawn.size(); ++row)
      if (const std::uint32_t own = level.index_first[row + 1] - level.index_first[row]; own > 0) drawn[row] = own;
    triangles.push_back(std::accumulate(drawn.begin(), drawn.end(), std::size_t{0}) / 3);
  }
  CAPTURE(triangles);
  CHECK(triangles[0] == 15884);
  CHECK(triangles[1] < 10'000);
  CHECK(triangles[2] < 8'000);
  CHECK(triangles[3] < 7'000);
}
