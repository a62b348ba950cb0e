#include "foliage/simplify.h"

#include <meshoptimizer.h>

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

}  // namespace manzana::foliage
