#include "foliage/stems.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "foliage/import/species.h"
#include "foliage/random.h"

using namespace manzana;
using namespace manzana::foliage;

namespace {
bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A species somewhere within the ranges that are accepted, and a little beyond.
SpeciesParams random_species(std::uint64_t seed) {
  Random random(seed);
  SpeciesParams s = builtin_species("broadleaf");
  const auto between = [&](float low, float high) { return low + (high - low) * random.uniform(); };
  s.shape = static_cast<int>(random.bits() % 9);
  s.scale = between(0.005F, 60);
  s.base_size = between(0, 1);
  s.ratio_power = between(-3, 3);
  s.attraction_up = between(-4, 4);
  s.levels = static_cast<int>(random.bits() % 5);
  s.base_splits = static_cast<int>(random.bits() % 4);
  for (StemParams& p : s.stems) {
    p.down_angle = between(-200, 200), p.down_angle_v = between(-90, 90);
    p.rotate = between(-360, 360), p.branches = static_cast<int>(random.bits() % 40);
    p.length = between(0, 2), p.length_v = between(0, 1), p.taper = between(0, 3.02F);
    p.curve_res = static_cast<int>(random.bits() % 12), p.curve = between(-400, 400), p.curve_back = between(-90, 90);
    p.seg_splits = between(0, 0.6F), p.split_angle = between(0, 90);
  }
  return s;
}
}  // namespace

TEST_CASE("shape_ratio has the values of the paper's table") {
  CHECK(shape_ratio(0, 0) == Approx(0.2));
  CHECK(shape_ratio(0, 1) == Approx(1));
  CHECK(shape_ratio(1, 0.5F) == Approx(1));
  CHECK(shape_ratio(1, 1) == Approx(0.2).margin(1e-6));
  CHECK(shape_ratio(2, 1) == Approx(1));
  CHECK(shape_ratio(3, 0.3F) == 1);
  CHECK(shape_ratio(4, 0) == Approx(0.5));
  CHECK(shape_ratio(5, 0.7F) == Approx(1));
  CHECK(shape_ratio(5, 1) == Approx(0).margin(1e-6));
  CHECK(shape_ratio(6, 1) == Approx(0.2));
  CHECK(shape_ratio(7, 1) == Approx(0.5));
}

TEST_CASE("stems are continuous, tapered, and as long as their segments") {
  const Skeleton skeleton = grow(builtin_species("broadleaf"), 4);
  REQUIRE(skeleton.stems.size() > 100);
  CHECK(skeleton.stems.front().level == 0);
  CHECK(skeleton.stems.front().points.front().position == Vec3(0));
  for (const Stem& stem : skeleton.stems) {
    float length = 0;
    for (std::size_t i = 1; i < stem.points.size(); ++i) {
      length += glm::length(stem.points[i].position - stem.points[i - 1].position);
      CHECK(stem.points[i].radius <= stem.points[i - 1].radius);
    }
    CHECK(length == Approx(stem.length).epsilon(1e-3));
    CHECK(stem.points.back().radius < 1e-4F);  // taper 1 ends in a point
    for (const StemPoint& p : stem.points) {
      CHECK(glm::length(p.frame[2]) == Approx(1).epsilon(1e-5));
      CHECK(std::abs(glm::dot(p.frame[0], p.frame[2])) < 1e-5F);
    }
  }
}

TEST_CASE("a branch starts on its trunk") {
  SpeciesParams species = builtin_species("conifer");
  const Skeleton skeleton = grow(species, 4);
  const Stem& trunk = skeleton.stems.front();
  for (const Stem& stem : skeleton.stems) {
    if (stem.level != 1) continue;
    float nearest = 1e9F;
    for (std::size_t i = 1; i < trunk.points.size(); ++i) {
      const Vec3 a = trunk.points[i - 1].position, d = trunk.points[i].position - a, p = stem.points[0].position - a;
      const float t = std::min(std::max(glm::dot(p, d) / glm::dot(d, d), 0.0F), 1.0F);
      nearest = std::min(nearest, glm::length(p - d * t));
    }
    CHECK(nearest < 1e-3F);
  }
}

TEST_CASE("splits add clones that end where the stem would") {
  SpeciesParams species = builtin_species("broadleaf");
  species.levels = 1;
  species.base_splits = 2;
  species.stems[0].split_angle = 30;
  const Skeleton skeleton = grow(species, 1);
  CHECK(skeleton.stems.size() == 3);
  for (const Stem& stem : skeleton.stems) CHECK(stem.level == 0);
}

TEST_CASE("random parameters give finite stems within the cap, or a refusal") {
  int grown = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    INFO("seed " << seed);
    try {
      const Skeleton skeleton = grow(random_species(seed), seed);
      std::size_t vertices = 4 * skeleton.leaves.size();
      bool all_finite = true, unit = true;
      for (const Stem& stem : skeleton.stems) {
        vertices += stem_vertices(stem);
        for (const StemPoint& p : stem.points) {
          all_finite = all_finite && finite(p.position) && std::isfinite(p.radius);
          unit = unit && std::abs(glm::length(p.frame[2]) - 1) < 1e-5F;
        }
      }
      for (const LeafSite& leaf : skeleton.leaves) all_finite = all_finite && finite(leaf.foot) && finite(leaf.axis);
      CHECK(vertices <= kMaxPlantVertices);
      CHECK(all_finite);
      CHECK(unit);
      ++grown;
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  CHECK(grown > 50);
  CHECK(refused > 20);
}
