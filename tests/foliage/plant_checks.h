#pragma once
/// What must hold for every plant, as it is read or grown and as it is prepared.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <initializer_list>

#include "foliage/prepare.h"

namespace manzana::foliage {

inline Vec3 unpack_normal(std::uint32_t packed) {
  const auto part = [&](int shift) {
    const int v = static_cast<int>((packed >> shift) & 1023U);
    return static_cast<float>(v > 511 ? v - 1024 : v) / 511;
  };
  return {part(0), part(10), part(20)};
}

inline float radius(const Vec3& p) { return std::hypot(p.x, p.y); }

/// What foliage/plant.h promises of rows and runs.
inline void check_runs(const Plant& plant) {
  CHECK_NOTHROW(check(plant));
  bool parents = true, lines = true, bark = true, leaves = true, finite = true;
  std::uint32_t line = 0, triangle = 0;
  for (std::size_t i = 0; i < plant.branches.size(); ++i) {
    const Branch& b = plant.branches[i];
    parents = parents && b.parent >= -1 && b.parent < static_cast<std::int32_t>(i);
    lines = lines && b.line.first == line && b.line.last >= line + 2;
    bark = bark && b.triangles.first == triangle && b.triangles.last >= triangle;
    line = b.line.last;
    triangle = b.triangles.last;
  }
  CHECK(parents);
  CHECK((lines && line == plant.centre_lines.size()));
  CHECK((bark && triangle == plant.mesh.bark.triangles()));
  triangle = 0;
  for (const Terminal& t : plant.terminals) {
    leaves = leaves && t.triangles.first == triangle && t.triangles.last > triangle && t.branch >= -1 &&
             t.branch < static_cast<std::int32_t>(plant.branches.size());
    triangle = t.triangles.last;
  }
  CHECK((leaves && triangle == plant.mesh.leaves.triangles()));
  for (const CentrePoint& c : plant.centre_lines)
    finite = finite && std::isfinite(glm::dot(c.position, c.position)) && c.radius >= 0 && c.radius < 1e6F;
  for (const MeshPart* part : {&plant.mesh.bark, &plant.mesh.leaves}) {
    for (const std::uint32_t i : part->indices) finite = finite && i < part->vertices.size();
    for (const MeshVertex& v : part->vertices)
      finite = finite && std::isfinite(glm::dot(v.position, v.position)) &&
               std::abs(glm::length(v.normal) - 1) < 1e-3F && v.uv.x >= 0 && v.uv.x <= kUvRange && v.uv.y >= 0 &&
               v.uv.y <= kUvRange && v.shade >= 0 && v.shade <= 1;
  }
  CHECK(finite);
}

inline std::uint64_t fnv(const void* data, std::size_t size, std::uint64_t h = 14695981039346656037ULL) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 1099511628211ULL;
  return h;
}

inline std::uint64_t fnv(const Plant& plant) {
  std::uint64_t h = fnv(plant.leaf_image.rgba.data(), plant.leaf_image.rgba.size());
  h = fnv(plant.bark_image.rgba.data(), plant.bark_image.rgba.size(), h);
  for (const MeshPart* part : {&plant.mesh.bark, &plant.mesh.leaves}) {
    h = fnv(part->vertices.data(), part->vertices.size() * sizeof(MeshVertex), h);
    h = fnv(part->indices.data(), part->indices.size() * sizeof(std::uint32_t), h);
  }
  return fnv(plant.centre_lines.data(), plant.centre_lines.size() * sizeof(CentrePoint), h);
}

/// Normals of unit length, nothing outside of the cylinder of the plant's size, and that touched at its side and lid.
inline void check_quads(const PreparedPlant& ready) {
  bool normals_unit = true;
  float top = 0, widest = 0;
  for (const auto* quads : {&ready.bark, &ready.leaves}) {
    for (const PlantQuad& quad : *quads) {
      for (std::size_t k = 0; k < 4; ++k) {
        normals_unit = normals_unit && std::abs(glm::length(unpack_normal(quad.normals[k])) - 1) < 0.005F;  // 10 bits
        top = std::max(top, quad.corners[k].position.z);
        widest = std::max(widest, radius(quad.corners[k].position));
      }
    }
  }
  CHECK(normals_unit);
  CHECK(top == Approx(ready.height_m).epsilon(1e-6));
  CHECK(widest == Approx(ready.crown_radius_m).epsilon(1e-6));
}

inline PreparedPlant prepared_blind(const Plant& plant) { return prepare(plant, {.visibility_side = 0}); }

/// Of a plant and of what is drawn of it: rows and runs, size, images, normals; and of each class what there was.
inline void check_plant(const Plant& plant) {
  INFO(plant.name);
  check_runs(plant);
  const PlantSize size = measure(plant.mesh);
  CHECK(size.height > 0);
  CHECK(size.radius > 0);
  for (const Image* image : {&plant.leaf_image, &plant.bark_image}) {
    CHECK(image->size == 256);
    CHECK(image->rgba.size() == 256 * 256 * 4);
  }
  const PreparedPlant ready = prepared_blind(plant);
  CHECK_NOTHROW(check(ready));
  CHECK(ready.height_m == size.height);
  CHECK(ready.crown_radius_m == size.radius);
  CHECK(ready.bark.empty() == plant.mesh.bark.indices.empty());
  CHECK(ready.leaves.empty() == plant.mesh.leaves.indices.empty());
  check_quads(ready);
}

}  // namespace manzana::foliage
