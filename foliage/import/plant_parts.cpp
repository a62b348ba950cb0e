#include "foliage/import/plant_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "foliage/import/gltf_triangles.h"
#include "foliage/import/plant_image.h"
#include "foliage/leaf_image.h"

namespace manzana::foliage {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

bool has_word(std::string_view name, std::span<const std::string_view> words) {
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return std::any_of(words.begin(), words.end(), [&](auto word) { return lower.find(word) != std::string::npos; });
}

/// True: leaf, false: bark.
std::optional<bool> leaf_by_name(std::string_view name) {
  static constexpr std::array<std::string_view, 6> kLeaf{"leaf", "leaves", "foliage", "needle", "frond", "crown"};
  static constexpr std::array<std::string_view, 6> kBark{"bark", "branch", "trunk", "wood", "stem", "pot"};
  if (has_word(name, kLeaf)) return true;
  if (has_word(name, kBark)) return false;
  return std::nullopt;
}

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

/// Materials with their pictures, each made when it is asked for.
class Looks {
 public:
  explicit Looks(const tinygltf::Model& model) : model_(model) {}

  const tinygltf::Material& material(int index) const {
    return index < 0 ? default_ : model_.materials[static_cast<std::size_t>(index)];
  }

  const Image& image(int index) {
    constexpr std::size_t kMostMaterials = 64;
    const auto found = images_.find(index);
    if (found != images_.end()) return found->second;
    if (images_.size() >= kMostMaterials) fail("more than 64 materials");
    return images_.emplace(index, make_image(material(index))).first->second;
  }

 private:
  Image make_image(const tinygltf::Material& m) const {
    Tint tint;
    const auto& factor = m.pbrMetallicRoughness.baseColorFactor;
    for (std::size_t c = 0; c < 4 && c < factor.size(); ++c)
      tint.factor[static_cast<int>(c)] =
          static_cast<float>(std::isfinite(factor[c]) ? std::clamp(factor[c], 0.0, 1.0) : 1);
    if (m.alphaMode == "MASK") tint.alpha_cutoff = static_cast<float>(std::clamp(m.alphaCutoff, 0.0, 1.0));
    if (m.alphaMode == "BLEND") tint.alpha_cutoff = 0.5F;
    const int texture = m.pbrMetallicRoughness.baseColorTexture.index;
    return plant_image(texture < 0 ? plain_picture() : decode_picture(image_bytes(model_, texture)), tint);
  }

  const tinygltf::Model& model_;
  tinygltf::Material default_;
  std::map<int, Image> images_;
};

bool has_alpha(const tinygltf::Material& m) { return m.alphaMode == "MASK" || m.alphaMode == "BLEND"; }

/// What each part is; nothing where the colour of each triangle must tell.
std::vector<std::optional<bool>> leaf_parts(const std::vector<GltfPart>& parts, const Looks& looks) {
  std::vector<std::optional<bool>> leaf;
  for (const GltfPart& part : parts) {
    const tinygltf::Material& m = looks.material(part.material);
    leaf.push_back(leaf_by_name(m.name));
    if (!leaf.back() && has_alpha(m)) leaf.back() = true;
  }
  const auto found_leaf = [&] { return std::find(leaf.begin(), leaf.end(), std::optional(true)) != leaf.end(); };
  const bool told = found_leaf();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (leaf[i]) continue;
    leaf[i] = leaf_by_name(parts[i].mesh_name);
    if (!leaf[i] && told) leaf[i] = false;
  }
  if (found_leaf()) return leaf;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (!leaf[i] && parts.size() > 1 && looks.material(parts[i].material).doubleSided) leaf[i] = true;
  return leaf;
}

bool is_green(const Image& image, const Vec2& uv) {
  const auto at = [&](float v) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>((v - std::floor(v)) * static_cast<float>(image.size)), 0, image.size - 1));
  };
  const std::uint8_t* p = &image.rgba[4 * (at(uv.y) * static_cast<std::size_t>(image.size) + at(uv.x))];
  return p[1] > p[0] && p[1] > p[2];
}

Vec2 middle_uv(const GltfPart& part, std::size_t t) {
  return (part.uvs[part.indices[t]] + part.uvs[part.indices[t + 1]] + part.uvs[part.indices[t + 2]]) / 3.0F;
}

double area(const GltfPart& part, std::size_t t) {
  const Vec3d& a = part.positions[part.indices[t]];
  return 0.5 *
         glm::length(glm::cross(part.positions[part.indices[t + 1]] - a, part.positions[part.indices[t + 2]] - a));
}

/// Where the plant stands: the middle of what is within a twentieth of the height of the lowest point.
Vec3d foot_of(const std::vector<GltfPart>& parts) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const GltfPart& part : parts)
    for (const std::uint32_t i : part.indices)
      low = std::min(low, part.positions[i].z), high = std::max(high, part.positions[i].z);
  Vec3d least(HUGE_VAL), most(-HUGE_VAL);
  for (const GltfPart& part : parts) {
    for (const std::uint32_t i : part.indices) {
      if (part.positions[i].z > low + 0.05 * (high - low)) continue;
      least = glm::min(least, part.positions[i]);
      most = glm::max(most, part.positions[i]);
    }
  }
  return {0.5 * (least.x + most.x), 0.5 * (least.y + most.y), low};
}

/// Whole repeats taken off, so that the triangle's texture coordinates lie in [0, kUvRange]; steps of half the range,
/// so that few vertices are split.
Vec2 uv_shift(const GltfPart& part, std::size_t t) {
  constexpr float kStep = kUvRange / 2;
  const Vec2 low =
      glm::min(glm::min(part.uvs[part.indices[t]], part.uvs[part.indices[t + 1]]), part.uvs[part.indices[t + 2]]);
  return -glm::floor(low / kStep) * kStep;
}

/// Copies triangles into one class, each vertex once for each shift of its texture coordinates.
class Collector {
 public:
  Collector(MeshPart& out, const GltfPart& part, const Vec3d& foot) : out_(out), part_(part), foot_(foot) {}

  void add(std::size_t t) {
    const Vec2 shift = uv_shift(part_, t);
    for (std::size_t k = 0; k < 3; ++k) out_.indices.push_back(vertex(part_.indices[t + k], shift));
  }

 private:
  std::uint32_t vertex(std::uint32_t i, const Vec2& shift) {
    const auto [found, added] =
        known_.try_emplace({i, shift.x, shift.y}, static_cast<std::uint32_t>(out_.vertices.size()));
    if (added) {
      const Vec2 uv = glm::clamp(part_.uvs[i] + shift, Vec2(0), Vec2(kUvRange));
      out_.vertices.push_back({Vec3(part_.positions[i] - foot_), part_.normals[i], uv});
    }
    return found->second;
  }

  MeshPart& out_;
  const GltfPart& part_;
  Vec3d foot_;
  std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> known_;
};

using AreaOfMaterial = std::map<int, double>;

int widest(const AreaOfMaterial& areas) {
  return std::max_element(areas.begin(), areas.end(), [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

PlantParts plant_parts(const tinygltf::Model& model) {
  const std::vector<GltfPart> parts = gltf_triangles(model);
  Looks looks(model);
  const auto leaf = leaf_parts(parts, looks);
  const Vec3d foot = foot_of(parts);
  PlantParts out;
  AreaOfMaterial leaf_areas, bark_areas;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const GltfPart& part = parts[i];
    Collector leaves(out.mesh.leaves, part, foot), bark(out.mesh.bark, part, foot);
    for (std::size_t t = 0; t + 2 < part.indices.size(); t += 3) {
      const bool is_leaf = leaf[i] ? *leaf[i] : is_green(looks.image(part.material), middle_uv(part, t));
      (is_leaf ? leaves : bark).add(t);
      (is_leaf ? leaf_areas : bark_areas)[part.material] += area(part, t);
    }
  }
  out.leaf = leaf_areas.empty() ? plant_image(plain_picture(), {}) : looks.image(widest(leaf_areas));
  out.bark = bark_areas.empty() ? plant_image(plain_picture(), {}) : looks.image(widest(bark_areas));
  return out;
}

}  // namespace manzana::foliage
