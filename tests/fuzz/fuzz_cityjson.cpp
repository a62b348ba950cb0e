// Any bytes, read as CityJSON: features that are sound, or a std::runtime_error, and nothing else. The first byte says
// whether as a document or as a sequence.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include "scenegraph/import/building_levels.h"
#include "scenegraph/import/cityjson.h"
#include "scenegraph/import/meshes.h"

namespace {

void require(bool sound) {
  if (!sound) std::abort();
}

void check(const manzana::CityFeatures& city) {
  for (const auto& work : city.constructions) {
    for (const manzana::Vec3d& p : work.points) require(std::isfinite(p.x + p.y + p.z));
    for (const std::uint32_t corner : work.corners) require(corner < work.points.size());
    require(work.part_last.empty() || work.part_last.back() == work.faces.size());
    require(work.faces.empty() || work.faces.back().last_ring == work.ring_last.size());
    const manzana::BlockFrame block = manzana::block_frame(city.frame, manzana::Vec2d(work.points.at(0)));
    manzana::CityMesh mesh;
    std::vector<manzana::Issue> issues;
    append_construction(mesh, {city.frame, block}, work, issues);
    for (const manzana::CityMesh& level : levels_of(mesh)) {
      for (const std::uint32_t i : level.indices) require(i < level.vertices.size());
      for (const manzana::CityVertex& v : level.vertices)
        require(std::isfinite(v.position.x + v.position.y + v.position.z));
    }
  }
  for (const auto& tree : city.trees)
    require(std::isfinite(tree.position.x) && tree.height > 0 && tree.crown_radius > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    check(manzana::read_cityjson_bytes(bytes, (data[0] & 1) != 0, {}, {}));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
