#include "foliage/leaf_points.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "foliage/leaf_image.h"
#include "foliage/leaf_quads.h"
#include "foliage/point_shade.h"
#include "foliage/poisson_disk.h"
#include "foliage/texel_mean.h"

namespace manzana::foliage {
namespace {

/// A place on a quad: how much of each corner.
using Weights = Vec4d;
using Piece = std::array<Weights, 3>;

Weights corner(std::size_t k) {
  Weights w(0);
  w[static_cast<int>(k)] = 1;
  return w;
}

Vec3d position_at(const PlantQuad& quad, const Weights& w) {
  Vec3d sum(0);
  for (int k = 0; k < 4; ++k) sum += Vec3d(quad.corners[static_cast<std::size_t>(k)].position) * w[k];
  return sum;
}

Vec2d uv_at(const PlantQuad& quad, const Weights& w) {
  Vec2d sum(0);
  for (int k = 0; k < 4; ++k) {
    const PlantQuad::Corner& c = quad.corners[static_cast<std::size_t>(k)];
    sum += Vec2d(c.u, c.v) * (w[k] * static_cast<double>(kUvRange) / 65535);
  }
  return sum;
}

double area_of(const PlantQuad& quad, const Piece& piece) {
  const Vec3d a = position_at(quad, piece[0]);
  return 0.5 * glm::length(glm::cross(position_at(quad, piece[1]) - a, position_at(quad, piece[2]) - a));
}

/// By the middle of the longest side.
std::array<Piece, 2> halves(const PlantQuad& quad, const Piece& t) {
  std::size_t side = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = glm::distance(position_at(quad, t[k]), position_at(quad, t[(k + 1) % 3]));
    if (length > longest * 1.000001) longest = length, side = k;
  }
  const Weights &a = t[side], &b = t[(side + 1) % 3], &c = t[(side + 2) % 3], middle = 0.5 * (a + b);
  return {Piece{a, middle, c}, Piece{middle, b, c}};
}

std::array<Piece, 2> triangles(const PlantQuad& quad) {
  const Piece first{corner(0), corner(1), corner(2)}, second{corner(0), corner(2), corner(3)};
  return is_triangle(quad) ? halves(quad, first) : std::array{first, second};
}

std::uint32_t packed_colour(const Vec3& linear, float contrast) {
  auto out = static_cast<std::uint32_t>(std::lround(contrast * 255)) << 24;
  for (int k = 0; k < 3; ++k) out |= std::uint32_t{srgb_of_linear(linear[k])} << (8 * k);
  return out;
}

/// Of a place on the quad.
CloudPoint point_at(const PlantQuad& quad, const Weights& w, Organ organ) {
  CloudPoint point;
  point.position = Vec3(position_at(quad, w));
  point.shade = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto share = static_cast<float>(w[static_cast<int>(k)]);
    point.normal += unpack_normal(quad.normals[k]) * share;
    point.shade += static_cast<float>(quad.shades[k]) / 255 * share;
  }
  point.level = quad.normals[0] >> 30;
  point.organ = organ;
  return point;
}

/// The piece of a triangle's shape that is 1 / shrink as long and wide, about `place` but inside.
Piece neighbourhood(const Piece& t, const Vec2d& place, double shrink) {
  const double size = 1 / shrink;
  Vec2d low = glm::max(place - Vec2d(size / 3), Vec2d(0));
  const auto over = [&] { return std::max(low.x + low.y + size - 1, 0.0); };
  low = glm::max(low - Vec2d(over() / 2), Vec2d(0));
  low = glm::max(low - Vec2d(over()), Vec2d(0));  // one of them is 0, and the other takes what is left
  const auto at = [&](const Vec2d& p) { return t[0] + (t[1] - t[0]) * p.x + (t[2] - t[0]) * p.y; };
  return {at(low), at(low + Vec2d(size, 0)), at(low + Vec2d(0, size))};
}

}  // namespace

LeafPoint packed(const CloudPoint& point) {
  const float mean = luminance(point.colour) * arriving(point.shade);
  const float contrast = mean > 0 ? std::sqrt(std::clamp(point.square / (mean * mean) - 1, 0.0F, 1.0F)) : 0;
  const float length = glm::length(point.normal);
  const Vec3 normal = length > 1e-6F ? point.normal / length : Vec3(0, 0, 1);
  return {point.position, point.area, pack_normal(normal) | (point.level << 30), packed_colour(point.colour, contrast),
          point.shade};
}

struct QuadPoints::Table {
  explicit Table(const Image& image) : means(image) {}

  const TexelMean& mean(const PlantQuad& quad, const Piece& piece) {
    const std::array<Vec2d, 3> uv{uv_at(quad, piece[0]), uv_at(quad, piece[1]), uv_at(quad, piece[2])};
    const std::array<double, 6> key{uv[0].x, uv[0].y, uv[1].x, uv[1].y, uv[2].x, uv[2].y};
    const auto found = known.find(key);
    return found != known.end() ? found->second : known.emplace(key, means.over(uv)).first->second;
  }

  CloudPoint point(const PlantQuad& quad, const Piece& piece, Organ organ) {
    const TexelMean& m = mean(quad, piece);
    CloudPoint point = point_at(quad, piece[0] * m.middle.x + piece[1] * m.middle.y + piece[2] * m.middle.z, organ);
    point.area = static_cast<float>(0.5 * area_of(quad, piece) * m.alpha);
    point.colour = Vec3(m.colour);
    const float light = arriving(point.shade);
    point.square = static_cast<float>(m.square) * light * light;
    return point;
  }

  TexelMeans means;
  std::map<std::array<double, 6>, TexelMean> known;
};

QuadPoints::QuadPoints(const Image& image) : table_(std::make_unique<Table>(image)) {}
QuadPoints::~QuadPoints() = default;

std::array<CloudPoint, 4> QuadPoints::four(const PlantQuad& quad, Organ organ) {
  std::array<CloudPoint, 4> points;
  std::size_t count = 0;
  for (const Piece& triangle : triangles(quad))
    for (const Piece& half : halves(quad, triangle)) points[count++] = table_->point(quad, half, organ);
  return points;
}

PointCloud QuadPoints::many(const PlantQuad& quad, Organ organ, std::uint32_t count, std::uint64_t seed) {
  const std::array<Piece, 2> pieces = triangles(quad);
  std::array<std::array<Vec3d, 3>, 2> surface;
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t k = 0; k < 3; ++k) surface[t][k] = position_at(quad, pieces[t][k]);
  constexpr double kAir = 0.01;  // a packed uv of 1 is a little more, and sees the other side of the picture
  PointCloud points;
  double sum = 0, wanted = 0;
  for (const SurfacePoint& at : poisson_disk(surface, {.count = count, .seed = seed})) {
    const Piece around = neighbourhood(pieces[at.triangle], at.place, std::sqrt(0.5 * count));
    if (table_->mean(quad, around).alpha > kAir) points.push_back(table_->point(quad, around, organ));
  }
  for (const CloudPoint& p : points) sum += static_cast<double>(p.area);
  for (const CloudPoint& p : four(quad, organ)) wanted += static_cast<double>(p.area);
  for (CloudPoint& p : points) p.area *= static_cast<float>(wanted / sum);
  return points;
}

}  // namespace manzana::foliage
