#include "foliage/import/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>

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

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

float area(const MeshPart& part, std::size_t t) {
  const Vec3& a = part.vertices[part.indices[t]].position;
  return glm::length(
      glm::cross(part.vertices[part.indices[t + 1]].position - a, part.vertices[part.indices[t + 2]].position - a));
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
  std::vector<std::uint32_t> indices(part.indices.size());
  constexpr float kAnyError = 1;  // of the extent
  std::size_t count = meshopt_simplify(indices.data(), part.indices.data(), part.indices.size(), positions(part),
                                       part.vertices.size(), sizeof(MeshVertex), 3 * triangles, kAnyError, 0, nullptr);
  if (count > 3 * triangles * 3 / 2 || count == 0)
    count = meshopt_simplifySloppy(indices.data(), part.indices.data(), part.indices.size(), positions(part),
                                   part.vertices.size(), sizeof(MeshVertex), 3 * triangles, kAnyError, nullptr);
  indices.resize(count);
  return compact(part, indices);
}

MeshPart largest_piece(const MeshPart& part) {
  if (part.indices.empty()) return part;
  // Vertices at one place count as joined: tubes have a seam.
  std::vector<std::uint32_t> parent(part.vertices.size());
  std::vector<std::uint32_t> same(part.indices.size());
  meshopt_generateShadowIndexBuffer(same.data(), part.indices.data(), part.indices.size(), part.vertices.data(),
                                    part.vertices.size(), sizeof(Vec3), sizeof(MeshVertex));
  std::iota(parent.begin(), parent.end(), 0U);
  for (std::size_t i = 0; i < same.size(); ++i) parent[root_of(parent, same[i])] = root_of(parent, same[i - i % 3]);
  std::vector<float> areas(part.vertices.size(), 0);
  for (std::size_t t = 0; t + 2 < same.size(); t += 3) areas[root_of(parent, same[t])] += area(part, t);
  const auto best = static_cast<std::uint32_t>(std::max_element(areas.begin(), areas.end()) - areas.begin());
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < same.size(); ++i)
    if (root_of(parent, same[i - i % 3]) == best) indices.push_back(part.indices[i]);
  return compact(part, indices);
}

}  // namespace manzana::foliage
