#pragma once
/// What must hold for every plant, and an oracle for coverage that works on the packed levels.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "foliage/plant.h"

namespace manzana::foliage {

inline Vec3 unpack_normal(std::uint32_t packed) {
  const auto part = [&](int shift) {
    const int v = static_cast<int>((packed >> shift) & 1023U);
    return static_cast<float>(v > 511 ? v - 1024 : v) / 511;
  };
  return {part(0), part(10), part(20)};
}

inline float radius(const Vec3& p) { return std::hypot(p.x, p.y); }

inline void check_level(const PlantLevel& level) {
  REQUIRE(level.indices.size() % 3 == 0);
  REQUIRE(level.bark_indices % 3 == 0);
  REQUIRE(level.bark_indices <= level.indices.size());
  bool indices_valid = true, bark_first = true, normals_unit = true, inside = true;
  for (std::size_t i = 0; i < level.indices.size(); ++i) {
    indices_valid = indices_valid && level.indices[i] < level.vertices.size();
    bark_first =
        bark_first && indices_valid && level.vertices[level.indices[i]].leaf == (i < level.bark_indices ? 0 : 1);
  }
  for (const PlantVertex& v : level.vertices) {
    normals_unit = normals_unit && std::abs(glm::length(unpack_normal(v.normal)) - 1) < 0.005F;  // 10 bits
    inside = inside && radius(v.position) <= 1 + 1e-6F && v.position.z <= 1;
  }
  CHECK(indices_valid);
  CHECK(bark_first);
  CHECK(normals_unit);
  CHECK(inside);
}

/// Bounds, order, indices and normals of all levels; the finest touches the unit cylinder's side and lid.
inline void check_plant(const PlantModel& model) {
  INFO(model.name);
  REQUIRE(!model.levels.empty());
  for (const PlantLevel& level : model.levels) check_level(level);
  float top = -1, widest = 0;
  for (const PlantVertex& v : model.levels.front().vertices) {
    top = std::max(top, v.position.z);
    widest = std::max(widest, radius(v.position));
  }
  CHECK(top == Approx(1).margin(1e-6));
  CHECK(widest == Approx(1).margin(1e-6));
  CHECK(model.height_m > 0);
  CHECK(model.crown_radius_m > 0);
  CHECK(model.levels.back().min_radius_px == 0);
  for (std::size_t i = 1; i < model.levels.size(); ++i)
    CHECK(model.levels[i].min_radius_px < model.levels[i - 1].min_radius_px);
  for (const Image* image : {&model.leaf, &model.bark}) {
    CHECK(image->size == 256);
    CHECK(image->rgba.size() == 256 * 256 * 4);
  }
}

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

inline std::uint64_t fnv(const PlantModel& model) {
  std::uint64_t h = fnv(model.leaf.rgba.data(), model.leaf.rgba.size());
  h = fnv(model.bark.rgba.data(), model.bark.rgba.size(), h);
  for (const PlantLevel& level : model.levels) {
    h = fnv(level.vertices.data(), level.vertices.size() * sizeof(PlantVertex), h);
    h = fnv(level.indices.data(), level.indices.size() * sizeof(std::uint32_t), h);
  }
  return h;
}

/// Share of the unit cylinder's rectangle that is covered, from the side; every sample against every triangle.
inline double covered_share(const PlantModel& model, const PlantLevel& level, double angle) {
  constexpr int kWide = 120, kHigh = 120;
  struct Corner {
    double x, y, u, v;
  };
  const auto project = [&](const PlantVertex& p) {
    return Corner{(static_cast<double>(p.position.x) * std::cos(angle) +
                   static_cast<double>(p.position.y) * std::sin(angle) + 1) /
                      2 * kWide,
                  static_cast<double>(p.position.z) * kHigh, p.u * 8.0 / 65535, p.v * 8.0 / 65535};
  };
  std::vector<char> hit(kWide * kHigh, 0);
  for (std::size_t t = 0; t < level.indices.size(); t += 3) {
    const Corner a = project(level.vertices[level.indices[t]]), b = project(level.vertices[level.indices[t + 1]]),
                 c = project(level.vertices[level.indices[t + 2]]);
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0) continue;
    const int x0 = std::max(0, static_cast<int>(std::min({a.x, b.x, c.x}))),
              y0 = std::max(0, static_cast<int>(std::min({a.y, b.y, c.y})));
    for (int y = y0; y < kHigh && y <= std::max({a.y, b.y, c.y}); ++y) {
      for (int x = x0; x < kWide && x <= std::max({a.x, b.x, c.x}); ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) / area;
        const double wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) / area;
        if (wb < 0 || wc < 0 || wb + wc > 1) continue;
        const int u = static_cast<int>((a.u + wb * (b.u - a.u) + wc * (c.u - a.u)) * 256) & 255;
        const int v = static_cast<int>((a.v + wb * (b.v - a.v) + wc * (c.v - a.v)) * 256) & 255;
        if (t < level.bark_indices || model.leaf.rgba[static_cast<std::size_t>(4 * (v * 256 + u) + 3)] >= 128)
          hit[static_cast<std::size_t>(y * kWide + x)] = 1;
      }
    }
  }
  double sum = 0;
  for (const char h : hit) sum += h;
  return sum / (kWide * kHigh);
}

}  // namespace manzana::foliage
