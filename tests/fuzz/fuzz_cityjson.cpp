// Any bytes, read as CityJSON: features that are sound, or a std::runtime_error, and nothing else. The first byte says
// whether as a document or as a sequence. Beside the "file" lies a picture, a.png.
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "scenegraph/import/building_levels.h"
#include "scenegraph/import/cityjson.h"
#include "scenegraph/import/meshes.h"
#include "scenegraph/import/picture_square.h"
#include "tests/fuzz/input_file.h"

namespace {

void require(bool sound) {
  if (!sound) std::abort();
}

/// 2 x 2 pixels.
constexpr unsigned char kPng[] = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
    0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0xfd, 0xd4, 0x9a, 0x73, 0x00, 0x00, 0x00, 0x12, 0x49,
    0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xc0, 0x00, 0xc2, 0x0c, 0xff, 0x81, 0x00, 0x00, 0x1f, 0xee,
    0x05, 0xfb, 0x0b, 0xd9, 0x68, 0x8b, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

void check(const manzana::Pictures& pictures) {
  for (const manzana::Texture& texture : pictures.textures) require(texture.picture < pictures.encoded.size());
  for (const manzana::EncodedPicture& picture : pictures.encoded) require(picture_square(picture, 4).has_value());
}

/// What a face wears, it wears at all of its corners.
void check_worn(const manzana::ConstructionFeature& work, const manzana::Pictures& pictures) {
  require(work.uv.empty() || work.uv.size() == work.corners.size());
  for (const manzana::Vec2& place : work.uv) require(std::isfinite(place.x + place.y));
  for (const auto& face : work.faces)
    require(face.texture <= pictures.textures.size() && (face.texture == 0 || !work.uv.empty()));
}

void check(const manzana::CityFeatures& city) {
  check(city.pictures);
  for (const auto& work : city.constructions) {
    for (const manzana::Vec3d& p : work.points) require(std::isfinite(p.x + p.y + p.z));
    for (const std::uint32_t corner : work.corners) require(corner < work.points.size());
    require(work.part_last.empty() || work.part_last.back() == work.faces.size());
    check_worn(work, city.pictures);
    require(work.faces.empty() || work.faces.back().last_ring == work.ring_last.size());
    const manzana::BlockFrame block = manzana::block_frame(city.frame, manzana::Vec2d(work.points.at(0)));
    manzana::CityMesh mesh;
    std::vector<manzana::Issue> issues;
    append_construction(mesh, {city.frame, block}, work, issues);
    require(mesh.textures.size() <= mesh.vertices.size());
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
  static const InputFile picture;
  static const std::filesystem::path folder = picture.with(kPng, "a.png").parent_path();
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    check(manzana::read_cityjson_bytes(bytes, (data[0] & 1) != 0, {}, {}, folder));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
