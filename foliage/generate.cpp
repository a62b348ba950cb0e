#include "foliage/generate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "foliage/few_cards.h"
#include "foliage/leaf_image.h"
#include "foliage/plant_mesh.h"
#include "foliage/random.h"
#include "foliage/stems.h"

namespace manzana::foliage {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kRootDepth = 0.03F;       // of the height: the trunk goes into the ground, for slopes
constexpr float kBarkTile = 1.2F;         // metres of a stem that one bark image covers
constexpr float kFineRadiusPx = 45;       // below it a leaf of the fine level is under a pixel
constexpr std::size_t kCoarseCards = 40;  // 80 triangles

MeshVertex ring_vertex(const StemPoint& at, int side, int sides, const Vec2& uv) {
  const float angle = 2 * kPi * static_cast<float>(side) / static_cast<float>(sides);
  const Vec3 out = at.frame[0] * std::cos(angle) + at.frame[1] * std::sin(angle);
  return {at.position + out * at.radius, out, uv};
}

/// A tube that ends in a point. The seam's vertices are double, for the bark's sake.
void add_tube(MeshPart& bark, const std::vector<StemPoint>& points, float length, int sides, float bark_repeats) {
  const auto first = static_cast<std::uint32_t>(bark.vertices.size());
  const auto row = static_cast<std::uint32_t>(sides + 1);
  const auto rings = static_cast<std::uint32_t>(points.size() - 1);
  const float v_end = std::min(length / kBarkTile, kUvRange);
  const auto v_at = [&](std::uint32_t ring) { return v_end * static_cast<float>(ring) / static_cast<float>(rings); };
  for (std::uint32_t r = 0; r < rings; ++r)
    for (int s = 0; s <= sides; ++s)
      bark.vertices.push_back(ring_vertex(points[r], s, sides,
                                          {bark_repeats * static_cast<float>(s) / static_cast<float>(sides), v_at(r)}));
  const StemPoint& tip = points.back();
  bark.vertices.push_back({tip.position, tip.frame[2], {0.5F * bark_repeats, v_end}});
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t s = 0; s + 1 < row; ++s) {
      const std::uint32_t a = first + r * row + s, b = a + 1, up = r + 1 == rings ? first + rings * row : a + row;
      bark.indices.insert(bark.indices.end(), {a, b, up});
      if (r + 1 < rings) bark.indices.insert(bark.indices.end(), {b, b + row, up});
    }
  }
}

/// Into the ground; and one more ring, since the flare falls off within the first segment.
void add_foot(std::vector<StemPoint>& points, float depth) {
  constexpr float kRing = 0.25F, kFlareLeft = 0.15F;  // of the first segment; of the flare, there
  StemPoint ring = points[0];
  ring.position = glm::mix(points[0].position, points[1].position, kRing);
  ring.radius = glm::mix(points[1].radius, points[0].radius, kFlareLeft);
  points[0].position.z -= depth;
  points.insert(points.begin() + 1, ring);
}

MeshPart bark_of(const Skeleton& skeleton) {
  MeshPart bark;
  for (const Stem& stem : skeleton.stems) {
    std::vector<StemPoint> points = stem.points;
    const bool clone = stem.level == 0 && stem.points.front().position.z > 0;
    if (stem.level == 0 && !clone) add_foot(points, kRootDepth * stem.length);
    add_tube(bark, points, stem.length, stem_sides(stem.level), stem.level == 0 ? 2 : 1);
  }
  return bark;
}

/// Every third point of the trunk, three sides.
MeshPart coarse_bark_of(const Skeleton& skeleton) {
  const Stem& trunk = skeleton.stems.front();
  std::vector<StemPoint> points;
  for (std::size_t i = 0; i + 1 < trunk.points.size(); i += 3) points.push_back(trunk.points[i]);
  points.push_back(trunk.points.back());
  points.front().position.z -= kRootDepth * trunk.length;
  MeshPart bark;
  add_tube(bark, points, trunk.length, 3, 2);
  return bark;
}

Vec3 any_direction(Random& random) {
  const float z = random.spread(1), angle = random.spread(kPi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Vec3 unit_or(const Vec3& v, const Vec3& other) {
  const float length = glm::length(v);
  return length > 1e-5F ? v / length : other;
}

/// A quad that grows along the site's axis and turns its face to the light: away from the crown's middle and up, more
/// or less.
std::array<MeshVertex, 4> leaf_card(const LeafSite& site, const Vec3& middle, const SpeciesParams& species,
                                    Random& random) {
  constexpr float kScatter = 0.9F;
  const Vec3 out = unit_or(site.foot - middle, {0, 0, 1});
  const Vec3 light = unit_or(out * 0.7F + Vec3(0, 0, 0.4F) + any_direction(random) * kScatter, {0, 0, 1});
  const Vec3 side = unit_or(glm::cross(light, site.axis), unit_or(glm::cross(Vec3(1, 0, 0), site.axis), {0, 1, 0}));
  const Vec3 normal = glm::cross(site.axis, side);
  const float length = species.leaf_scale * site.scale * (1 + random.spread(0.2F));
  const Vec3 half = side * (0.5F * length * species.leaf_scale_x), up = site.axis * length;
  const float left = random.bits() & 1 ? 0.0F : 1.0F;  // half of the cards show the image mirrored
  return {MeshVertex{site.foot - half, normal, {left, 1}}, MeshVertex{site.foot + half, normal, {1 - left, 1}},
          MeshVertex{site.foot + half + up, normal, {1 - left, 0}},
          MeshVertex{site.foot - half + up, normal, {left, 0}}};
}

MeshPart leaves_of(const Skeleton& skeleton, const SpeciesParams& species, std::uint64_t seed) {
  Vec3 middle(0);
  for (const LeafSite& site : skeleton.leaves) middle += site.foot / static_cast<float>(skeleton.leaves.size());
  MeshPart leaves;
  for (std::size_t i = 0; i < skeleton.leaves.size(); ++i) {
    Random random(hash(seed, i));
    add_quad(leaves, leaf_card(skeleton.leaves[i], middle, species, random));
  }
  return leaves;
}

}  // namespace

PlantModel generate_plant(const SpeciesParams& species, std::uint64_t seed) {
  const Skeleton skeleton = grow(species, seed);
  PlantMesh fine{bark_of(skeleton), leaves_of(skeleton, species, hash(seed, 2))};
  const CrownLight light(fine.leaves);
  light.apply(fine);
  PlantModel model;
  model.name = species.name;
  const PlantSize size = measure(fine);
  if (!(size.height > 0 && size.radius > 0))
    throw std::invalid_argument("species " + species.name + ": the plant has no size");
  model.height_m = size.height;
  model.crown_radius_m = size.radius;
  model.leaf = leaf_image(species.leaf_shape, species.leaf_rgb, hash(seed, 3));
  model.bark = bark_image(species.bark_rgb, hash(seed, 4));
  PlantMesh coarse{coarse_bark_of(skeleton), {}};
  coarse.leaves = few_cards(fine, coarse.bark, {model.leaf, size}, kCoarseCards);
  light.apply(coarse);
  take_light(coarse.leaves, fine.leaves);
  model.levels = {finish_level(fine, size, kFineRadiusPx), finish_level(coarse, size, 0)};
  return model;
}

}  // namespace manzana::foliage
