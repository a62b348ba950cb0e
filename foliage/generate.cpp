#include "foliage/generate.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "foliage/leaf_image.h"
#include "foliage/plant_mesh.h"
#include "foliage/random.h"
#include "foliage/stems.h"
#include "foliage/tube.h"

namespace manzana::foliage {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kRootDepth = 0.03F;  // of the height: the trunk goes into the ground, for slopes

std::uint32_t triangles_of(const MeshPart& part) { return static_cast<std::uint32_t>(part.triangles()); }

/// Into the ground; and one more ring, since the flare falls off within the first segment.
void add_foot(std::vector<StemPoint>& points, float depth) {
  constexpr float kRing = 0.25F, kFlareLeft = 0.15F;  // of the first segment; of the flare, there
  StemPoint ring = points[0];
  ring.position = glm::mix(points[0].position, points[1].position, kRing);
  ring.radius = glm::mix(points[1].radius, points[0].radius, kFlareLeft);
  points[0].position.z -= depth;
  points.insert(points.begin() + 1, ring);
}

Vec3 any_direction(Random& random) {
  const float z = random.spread(1), angle = random.spread(kPi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Vec3 unit_or(const Vec3& v, const Vec3& other) {
  const float length = glm::length(v);
  return length > 1e-5F ? v / length : other;
}

bool has_organs(const SpeciesParams& species) { return species.organ != "none"; }

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
  const float low = has_organs(species) ? 1 - kOrganSide : 1;
  return {MeshVertex{site.foot - half, normal, {left, low}}, MeshVertex{site.foot + half, normal, {1 - left, low}},
          MeshVertex{site.foot + half + up, normal, {1 - left, 0}},
          MeshVertex{site.foot - half + up, normal, {left, 0}}};
}

void add_leaves(Plant& plant, const Skeleton& skeleton, const SpeciesParams& species, std::uint64_t seed) {
  Vec3 middle(0);
  for (const LeafSite& site : skeleton.leaves) middle += site.foot / static_cast<float>(skeleton.leaves.size());
  for (std::size_t i = 0; i < skeleton.leaves.size(); ++i) {
    Random random(hash(seed, i));
    const std::uint32_t first = triangles_of(plant.mesh.leaves);
    add_quad(plant.mesh.leaves, leaf_card(skeleton.leaves[i], middle, species, random));
    plant.terminals.push_back({{first, triangles_of(plant.mesh.leaves)}, skeleton.leaves[i].stem, Organ::leaf});
  }
}

/// Two quads across each other, along the site's axis. The picture's upper edge is where it hangs, or a flower's end.
void add_organ(Plant& plant, const LeafSite& site, const SpeciesParams& species) {
  const bool fruit = species.organ == "fruit";
  const Vec3 side = unit_or(glm::cross(site.axis, Vec3(1, 0, 0)), {0, 1, 0});
  const Vec3 up = site.axis * (species.organ_scale * site.scale);
  const std::uint32_t first = triangles_of(plant.mesh.leaves);
  const float near = fruit ? 1 - kOrganSide : 1, far = fruit ? 1 : 1 - kOrganSide;
  for (const Vec3& across : {side, glm::cross(site.axis, side)}) {
    const Vec3 half = across * (0.5F * species.organ_scale * site.scale), normal = glm::cross(across, site.axis);
    add_quad(plant.mesh.leaves,
             {MeshVertex{site.foot - half, normal, {0, near}}, MeshVertex{site.foot + half, normal, {kOrganSide, near}},
              MeshVertex{site.foot + half + up, normal, {kOrganSide, far}},
              MeshVertex{site.foot - half + up, normal, {0, far}}});
  }
  plant.terminals.push_back(
      {{first, triangles_of(plant.mesh.leaves)}, site.stem, fruit ? Organ::fruit : Organ::flower});
}

std::optional<OrganLook> organ_look(const SpeciesParams& species) {
  if (!has_organs(species)) return std::nullopt;
  return OrganLook{species.organ == "fruit" ? Organ::fruit : Organ::flower, species.organ_rgb};
}

}  // namespace

Plant grow_plant(const SpeciesParams& species, std::uint64_t seed) {
  const Skeleton skeleton = grow(species, seed);
  Plant plant;
  plant.name = species.name;
  for (const Stem& stem : skeleton.stems) {
    std::vector<StemPoint> points = stem.points;
    if (stem.parent < 0) add_foot(points, kRootDepth * stem.length);
    add_branch(plant, stem, points);
  }
  add_leaves(plant, skeleton, species, hash(seed, 2));
  for (const LeafSite& site : skeleton.organs) add_organ(plant, site, species);
  plant.leaf_image = leaf_image(species.leaf_shape, species.leaf_rgb, hash(seed, 3), organ_look(species));
  plant.bark_image = bark_image(species.bark_rgb, hash(seed, 4));
  const PlantSize size = measure(plant.mesh);
  if (!(size.height > 0 && size.radius > 0))
    throw std::invalid_argument("species " + species.name + ": the plant has no size");
  CrownLight(plant.mesh.leaves).apply(plant.mesh);
  return plant;
}

}  // namespace manzana::foliage
