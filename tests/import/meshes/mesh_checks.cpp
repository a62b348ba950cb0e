#include "tests/import/meshes/mesh_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "scenegraph/import/plan_geometry.h"

namespace checks {

std::uint64_t Random::bits() {
  std::uint64_t x = (state += 0x9e3779b97f4a7c15U);
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}
double Random::unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

Vec3 unpack_normal(std::uint32_t packed) {
  const auto field = [packed](int shift) {
    const auto bits = static_cast<std::int32_t>(packed >> shift & 1023U);
    return static_cast<float>(bits >= 512 ? bits - 1024 : bits) / 511.0F;
  };
  return {field(0), field(10), field(20)};
}

Material material(const CityVertex& vertex) { return static_cast<Material>(vertex.colour >> 24); }

namespace {
std::string triangle_text(std::size_t row, const std::array<Vec3d, 3>& p, const Vec3d& cross) {
  std::ostringstream text;
  text << "triangle " << row;
  for (const Vec3d& q : {p[0], p[1], p[2], cross}) text << " (" << q.x << ' ' << q.y << ' ' << q.z << ')';
  return text.str();
}
}  // namespace

std::string fault(const CityMesh& mesh) {
  for (const CityVertex& v : mesh.vertices) {
    const bool finite = std::isfinite(v.position.x) && std::isfinite(v.position.y) && std::isfinite(v.position.z);
    if (!finite || !std::isfinite(v.uv.x) || !std::isfinite(v.uv.y)) return "a vertex is not finite";
    if (std::abs(glm::length(unpack_normal(v.normal)) - 1) > 0.005F) return "a normal is not of unit length";
    if (material(v) >= Material::count) return "no such material";
  }
  if (mesh.indices.size() % 3 != 0) return "not triangles";
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<Vec3d, 3> p;
    Vec3d mean{0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.indices[i + k] >= mesh.vertices.size()) return "an index out of range";
      p[k] = mesh.vertices[mesh.indices[i + k]].position;
      mean += Vec3d(unpack_normal(mesh.vertices[mesh.indices[i + k]].normal));
    }
    const Vec3d cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    // Slivers thinner than 1 cm have no direction after rounding to float.
    if (glm::length(cross) > 1e-2 * longest && glm::dot(glm::normalize(cross), glm::normalize(mean)) < 0.97)
      return triangle_text(i / 3, p, cross) + " does not face along its normal";
  }
  return {};
}

double volume(const CityMesh& mesh) {
  double six = 0;
  const Vec3d origin = mesh.vertices.empty() ? Vec3d{0, 0, 0} : Vec3d(mesh.vertices[0].position);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) { return Vec3d(mesh.vertices[mesh.indices[i + k]].position) - origin; };
    six += glm::dot(p(0), glm::cross(p(1), p(2)));
  }
  return six / 6;
}

double area(const CityMesh& mesh, Material kind) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto p = [&](std::size_t k) { return Vec3d(mesh.vertices[mesh.indices[i + k]].position); };
    if (material(mesh.vertices[mesh.indices[i]]) == kind) sum += glm::length(glm::cross(p(1) - p(0), p(2) - p(0))) / 2;
  }
  return sum;
}

std::size_t open_edges(const CityMesh& mesh, double tolerance) {
  std::vector<Vec3d> corners;
  std::vector<std::uint32_t> corner(mesh.vertices.size());
  std::map<std::array<long, 3>, std::vector<std::uint32_t>> cells;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3d p(mesh.vertices[v].position);
    const Vec3d cell = glm::floor(p / (4 * tolerance));
    std::uint32_t found = UINT32_MAX;
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        for (long dz = -1; dz <= 1; ++dz) {
          const auto at = cells.find({long(cell.x) + dx, long(cell.y) + dy, long(cell.z) + dz});
          if (at == cells.end()) continue;
          for (const std::uint32_t c : at->second)
            if (glm::distance(corners[c], p) < tolerance) found = c;
        }
    if (found == UINT32_MAX) {
      found = static_cast<std::uint32_t>(corners.size());
      corners.push_back(p);
      cells[{long(cell.x), long(cell.y), long(cell.z)}].push_back(found);
    }
    corner[v] = found;
  }
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[mesh.indices[i + k]], b = corner[mesh.indices[i + (k + 1) % 3]];
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  return static_cast<std::size_t>(
      std::count_if(balance.begin(), balance.end(), [](const auto& entry) { return entry.second != 0; }));
}

void add_bottom(CityMesh& mesh, const std::vector<Polygon>& footprint, double z) {
  const Geos geos;
  for (const Polygon& p : footprint)
    for (const auto& [a, b, c] : plan::triangulate(geos, p)) {
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Vec2d& q : {a, c, b}) mesh.vertices.push_back({Vec3(Vec3d(q, z)), pack_normal({0, 0, -1}), 0, {}, 0});
      mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
    }
}

Polygon rectangle(double x, double y, double width, double depth) {
  return {{{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}}, {}};
}

std::vector<Vec2d> star(Random& random, const Vec2d& center, int corners, double least, double most) {
  std::vector<Vec2d> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + 0.6 * random.unit()) / corners;
    ring.push_back(center + random.between(least, most) * Vec2d{std::cos(angle), std::sin(angle)});
  }
  return ring;
}

std::vector<Vec2d> turned(std::vector<Vec2d> ring, double angle) {
  for (Vec2d& p : ring)
    p = {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)};
  return ring;
}

}  // namespace checks
