#include "foliage/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "foliage/sets.h"

namespace manzana::foliage {
namespace {

static_assert(sizeof(MeshVertex) == 9 * sizeof(float));  // no padding: compared byte by byte

const float* positions(const MeshPart& part) { return &part.vertices.data()->position.x; }

MeshPart compact(const MeshPart& part, const std::vector<std::uint32_t>& indices) {
  MeshPart out;
  std::vector<std::uint32_t> place(part.vertices.size(), ~0U);
  for (const std::uint32_t i : indices) {
    if (place[i] == ~0U) {
      place[i] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(part.vertices[i]);
    }
    out.indices.push_back(place[i]);
  }
  return out;
}

float area(const MeshPart& part, std::size_t t) {
  const Vec3& a = part.vertices[part.indices[t]].position;
  return glm::length(
      glm::cross(part.vertices[part.indices[t + 1]].position - a, part.vertices[part.indices[t + 2]].position - a));
}

/// Indices of the first vertex at each place: where normals or texture coordinates differ a surface would count as
/// torn.
std::vector<std::uint32_t> joined_by_place(const MeshPart& part) {
  std::vector<std::uint32_t> joined(part.indices.size());
  meshopt_generateShadowIndexBuffer(joined.data(), part.indices.data(), part.indices.size(), part.vertices.data(),
                                    part.vertices.size(), sizeof(Vec3), sizeof(MeshVertex));
  return joined;
}

constexpr float kAnyError = 1;  // of the extent

std::vector<std::uint32_t> collapsed(const MeshPart& part, std::vector<std::uint32_t> indices, std::size_t triangles) {
  indices.resize(meshopt_simplify(indices.data(), indices.data(), indices.size(), positions(part), part.vertices.size(),
                                  sizeof(MeshVertex), 3 * triangles, kAnyError, 0, nullptr));
  return indices;
}

std::vector<std::uint32_t> merged_cells(const MeshPart& part, std::size_t triangles) {
  std::vector<std::uint32_t> indices(part.indices.size());
  indices.resize(meshopt_simplifySloppy(indices.data(), part.indices.data(), indices.size(), positions(part),
                                        part.vertices.size(), sizeof(MeshVertex), 3 * triangles, kAnyError, nullptr));
  return indices;
}

/// The grid's steps are coarse, and it falls far short of its target at times: the finest grid that is near enough.
std::vector<std::uint32_t> best_merged_cells(const MeshPart& part, std::size_t triangles) {
  std::vector<std::uint32_t> best = merged_cells(part, triangles);
  for (std::size_t target = triangles + triangles / 3; target < 4 * triangles; target += triangles / 3 + 1) {
    std::vector<std::uint32_t> finer = merged_cells(part, target);
    if (finer.size() > 3 * (triangles + triangles / 3)) break;
    best = std::move(finer);
  }
  return best;
}

}  // namespace

MeshPart welded(const MeshPart& part) {
  if (part.indices.empty()) return {};
  std::vector<std::uint32_t> remap(part.vertices.size());
  meshopt_generateVertexRemap(remap.data(), part.indices.data(), part.indices.size(), part.vertices.data(),
                              part.vertices.size(), sizeof(MeshVertex));
  std::vector<std::uint32_t> first(part.vertices.size(), ~0U), indices;
  for (const std::uint32_t i : part.indices) {
    std::uint32_t& f = first[remap[i]];
    if (f == ~0U) f = i;
    indices.push_back(f);
  }
  return compact(part, indices);
}

MeshPart simplified(const MeshPart& part, std::size_t triangles) {
  if (part.triangles() <= triangles) return part;
  const std::size_t enough = 3 * (triangles + triangles / 2);
  std::vector<std::uint32_t> indices = collapsed(part, part.indices, triangles);
  if (indices.size() > enough) indices = collapsed(part, joined_by_place(part), triangles);
  if (indices.size() > enough || indices.empty()) indices = best_merged_cells(part, triangles);
  return compact(part, indices);
}

Reduced simplified_within(const MeshPart& part, float error_m) {
  const float scale =
      part.indices.empty() ? 0 : meshopt_simplifyScale(positions(part), part.vertices.size(), sizeof(MeshVertex));
  if (!(scale > 0)) return {part, 0};
  std::vector<std::uint32_t> indices = part.indices;
  float error = 0;
  indices.resize(meshopt_simplify(indices.data(), indices.data(), indices.size(), positions(part), part.vertices.size(),
                                  sizeof(MeshVertex), 0, error_m / scale, 0, &error));
  return {compact(part, indices), error * scale};
}

MeshPart largest_piece(const MeshPart& part) {
  if (part.indices.empty()) return part;
  const std::vector<std::uint32_t> same = joined_by_place(part);
  Sets sets(part.vertices.size());
  for (std::size_t i = 0; i < same.size(); ++i) sets.join(same[i], same[i - i % 3]);
  std::vector<float> areas(part.vertices.size(), 0);
  for (std::size_t t = 0; t + 2 < same.size(); t += 3) areas[sets.find(same[t])] += area(part, t);
  const auto best = static_cast<std::uint32_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < same.size(); ++i)
    if (sets.find(same[i - i % 3]) == best) indices.push_back(part.indices[i]);
  return compact(part, indices);
}

}  // namespace manzana::foliage
