#include "scenegraph/import/terrain.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace manzana {
namespace {

/// Where a point is: its cell, and how far in it.
struct InCell {
  std::size_t corner = 0;  // the cell's lower left
  Vec2d share{0, 0};
};

InCell cell_of(const Terrain& terrain, const Vec2d& plan) {
  const Vec2d most(terrain.columns - 1, terrain.rows - 1);
  const Vec2d at = glm::clamp((plan - terrain.origin) / terrain.step, Vec2d(0), most);
  const Vec2d cell = glm::min(glm::floor(at), most - 1.0);
  return {static_cast<std::size_t>(cell.y) * terrain.columns + static_cast<std::size_t>(cell.x), at - cell};
}

/// A corner of a piece of a triangle, on the way.
struct Corner {
  Vec3d position;  // (x, y, height above ground)
  Vec3 normal;
  Vec2 uv;
};
using Piece = std::vector<Corner>;

Corner between(const Corner& a, const Corner& b, double t) {
  const auto f = static_cast<float>(t);
  return {glm::mix(a.position, b.position, t), glm::mix(a.normal, b.normal, f), glm::mix(a.uv, b.uv, f)};
}

/// In units of cells: the east, the north, and across the diagonals.
double along(const Terrain& terrain, const Vec3d& p, int direction) {
  const Vec2d at = (Vec2d(p) - terrain.origin) / terrain.step;
  return direction == 0 ? at.x : direction == 1 ? at.y : at.x - at.y;
}

/// The parts of a convex piece on both sides of the line where `along` is k.
std::pair<Piece, Piece> cut(const Terrain& terrain, const Piece& piece, int direction, double k) {
  constexpr double kOnLine = 1e-9;
  std::pair<Piece, Piece> sides;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Corner &a = piece[i], &b = piece[(i + 1) % piece.size()];
    const double da = along(terrain, a.position, direction) - k, db = along(terrain, b.position, direction) - k;
    if (da <= kOnLine) sides.first.push_back(a);
    if (da >= -kOnLine) sides.second.push_back(a);
    if ((da < -kOnLine && db > kOnLine) || (da > kOnLine && db < -kOnLine)) {
      const Corner on = between(a, b, da / (da - db));
      sides.first.push_back(on);
      sides.second.push_back(on);
    }
  }
  return sides;
}

/// Along all lines of a direction.
std::vector<Piece> cut_all(const Terrain& terrain, std::vector<Piece> pieces, int direction) {
  std::vector<Piece> done;
  const double last = std::max(terrain.columns, terrain.rows);
  for (Piece& piece : pieces) {
    double low = last, high = -last;
    for (const Corner& c : piece) {
      low = std::min(low, along(terrain, c.position, direction));
      high = std::max(high, along(terrain, c.position, direction));
    }
    for (double k = std::max(std::floor(low) + 1, -last); k < std::min(high, last) && piece.size() >= 3; ++k) {
      auto [below, above] = cut(terrain, piece, direction, k);
      if (below.size() >= 3) done.push_back(std::move(below));
      piece = std::move(above);
    }
    if (piece.size() >= 3) done.push_back(std::move(piece));
  }
  return done;
}

/// A height z above a ground h(x, y): normals turn by the inverse transpose of what moves positions.
Vec3 on_slope(const Vec3& normal, const Vec2d& slope) {
  const Vec3d n(normal);
  return Vec3(glm::normalize(Vec3d(n.x - slope.x * n.z, n.y - slope.y * n.z, n.z)));
}

class Draper {
 public:
  Draper(CityMesh& mesh, const Vec2d& center, const Terrain& terrain)
      : mesh_(mesh), center_(center), terrain_(terrain) {}

  void run() {
    const std::vector<std::uint32_t> indices = std::move(mesh_.indices);
    mesh_.indices.clear();
    const std::size_t own = mesh_.vertices.size();
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) add({indices[i], indices[i + 1], indices[i + 2]});
    for (std::size_t i = 0; i < own; ++i) raise(mesh_.vertices[i]);
  }

 private:
  Corner corner(std::uint32_t i) const {
    const CityVertex& v = mesh_.vertices[i];
    return {
        {center_ + Vec2d(v.position.x, v.position.y), v.position.z}, Vec3(glm::unpackSnorm3x10_1x2(v.normal)), v.uv};
  }

  void add(const std::array<std::uint32_t, 3>& triangle) {
    std::vector<Piece> pieces{{corner(triangle[0]), corner(triangle[1]), corner(triangle[2])}};
    for (const int direction : {0, 1, 2}) pieces = cut_all(terrain_, std::move(pieces), direction);
    if (pieces.size() <= 1) {
      mesh_.indices.insert(mesh_.indices.end(), triangle.begin(), triangle.end());
      return;
    }
    for (const Piece& piece : pieces) add(piece, mesh_.vertices[triangle[0]].colour);
  }

  void add(const Piece& piece, std::uint32_t colour) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const Corner& c : piece) {
      CityVertex v{Vec3(c.position - Vec3d(center_, 0)), pack_normal(glm::normalize(c.normal)), colour, c.uv, 0};
      raise(v);
      mesh_.vertices.push_back(v);
    }
    for (std::uint32_t k = 2; k < piece.size(); ++k)
      mesh_.indices.insert(mesh_.indices.end(), {first, first + k - 1, first + k});
  }

  void raise(CityVertex& v) const {
    const Vec2d plan = center_ + Vec2d(v.position.x, v.position.y);
    v.position.z += static_cast<float>(terrain_.at(plan));
    v.normal = pack_normal(on_slope(Vec3(glm::unpackSnorm3x10_1x2(v.normal)), terrain_.slope_at(plan)));
  }

  CityMesh& mesh_;
  const Vec2d center_;
  const Terrain& terrain_;
};

}  // namespace

double Terrain::at(const Vec2d& plan) const {
  if (level()) return 0;
  const InCell in = cell_of(*this, plan);
  const auto h = [&](std::size_t right, std::size_t up) {
    return static_cast<double>(heights[in.corner + up * columns + right]);
  };
  const double low = h(0, 0), high = h(1, 1);
  return in.share.x >= in.share.y ? low + in.share.x * (h(1, 0) - low) + in.share.y * (high - h(1, 0))
                                  : low + in.share.y * (h(0, 1) - low) + in.share.x * (high - h(0, 1));
}

Vec2d Terrain::slope_at(const Vec2d& plan) const {
  if (level()) return {0, 0};
  const Vec2d east(step / 2, 0), north(0, step / 2);
  return Vec2d(at(plan + east) - at(plan - east), at(plan + north) - at(plan - north)) / step;
}

void drape(CityMesh& mesh, const Vec2d& center, const Terrain& terrain) {
  if (!terrain.level()) Draper(mesh, center, terrain).run();
}

}  // namespace manzana
