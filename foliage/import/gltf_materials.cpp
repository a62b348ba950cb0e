#include "foliage/import/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "foliage/import/classify_triangles.h"
#include "foliage/import/plant_image.h"

namespace manzana::foliage {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// The encoded bytes of a texture's image.
std::span<const unsigned char> image_bytes(const tinygltf::Model& model, int texture) {
  if (static_cast<std::size_t>(texture) >= model.textures.size())
    fail("there is no texture " + std::to_string(texture));
  const int source = model.textures[static_cast<std::size_t>(texture)].source;
  if (source < 0 || static_cast<std::size_t>(source) >= model.images.size())
    fail("texture " + std::to_string(texture) + " has no image");
  const tinygltf::Image& image = model.images[static_cast<std::size_t>(source)];
  if (image.bufferView < 0) {
    if (image.image.empty()) fail("its texture " + image.uri + " is absent");
    return image.image;
  }
  if (static_cast<std::size_t>(image.bufferView) >= model.bufferViews.size()) fail("an image has no buffer view");
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(image.bufferView)];
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  return std::span(data).subspan(view.byteOffset, view.byteLength);
}

Image image_of(const tinygltf::Model& model, const tinygltf::Material& m) {
  Tint tint;
  const auto& factor = m.pbrMetallicRoughness.baseColorFactor;
  for (std::size_t c = 0; c < 4 && c < factor.size(); ++c)
    tint.factor[static_cast<int>(c)] =
        static_cast<float>(std::isfinite(factor[c]) ? std::clamp(factor[c], 0.0, 1.0) : 1);
  if (m.alphaMode == "MASK") tint.alpha_cutoff = static_cast<float>(std::clamp(m.alphaCutoff, 0.0, 1.0));
  if (m.alphaMode == "BLEND") tint.alpha_cutoff = 0.5F;
  const int texture = m.pbrMetallicRoughness.baseColorTexture.index;
  return plant_image(texture < 0 ? plain_picture() : decode_picture(image_bytes(model, texture)), tint);
}

}  // namespace

std::vector<SourceMaterial> gltf_materials(const tinygltf::Model& model) {
  std::vector<SourceMaterial> out;
  for (const tinygltf::Material& m : model.materials)
    out.push_back({m.name, told_by_extras(m.extras), m.alphaMode == "MASK" || m.alphaMode == "BLEND",
                   [&model, &m] { return image_of(model, m); }});
  return out;
}

std::optional<PlantPart> told_by_extras(const tinygltf::Value& extras) {
  if (!extras.IsObject() || !extras.Has("organ") || !extras.Get("organ").IsString()) return std::nullopt;
  return part_by_name(extras.Get("organ").Get<std::string>());
}

}  // namespace manzana::foliage
