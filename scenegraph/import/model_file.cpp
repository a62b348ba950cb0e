#include "scenegraph/import/model_file.h"

#include <map>
#include <stdexcept>

#include "foliage/import/gltf_files.h"
#include "foliage/import/gltf_materials.h"
#include "foliage/import/gltf_triangles.h"
#include "foliage/leaf_image.h"

namespace manzana {
namespace {

using MeshPtr = std::shared_ptr<const NodeMesh>;

/// In linear light, weighted by alpha; NodeVertex::colour.
std::uint32_t mean_colour(const foliage::Image& image) {
  glm::dvec4 sum(0);
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const double alpha = image.rgba[i + 3] / 255.0;
    const auto linear = [&](std::size_t c) { return foliage::linear_of_srgb(image.rgba[i + c]); };
    sum += alpha * glm::dvec4(linear(0), linear(1), linear(2), 1);
  }
  if (!(sum.w > 0)) return 0xFFFFFF;
  const auto srgb = [&](double c) { return std::uint32_t{foliage::srgb_of_linear(static_cast<float>(c / sum.w))}; };
  return srgb(sum.x) | srgb(sum.y) << 8 | srgb(sum.z) << 16;
}

/// White where there is none, or its picture cannot be read: a shape without its colour is better than none.
std::vector<std::uint32_t> colours_of(const tinygltf::Model& gltf) {
  std::vector<std::uint32_t> colours;
  for (const foliage::SourceMaterial& material : foliage::gltf_materials(gltf)) {
    try {
      colours.push_back(mean_colour(material.image()));
    } catch (const std::runtime_error&) {
      colours.push_back(0xFFFFFF);
    }
  }
  return colours;
}

MeshPtr mesh_of(const std::vector<foliage::SourcePart>& parts, const std::vector<std::uint32_t>& colours) {
  const auto mesh = std::make_shared<NodeMesh>();
  for (const foliage::SourcePart& part : parts) {
    const auto base = static_cast<std::uint32_t>(mesh->vertices.size());
    const std::uint32_t colour = part.material < 0 ? 0xFFFFFF : colours[static_cast<std::size_t>(part.material)];
    for (std::size_t i = 0; i < part.positions.size(); ++i)
      mesh->vertices.push_back({Vec3(part.positions[i]), pack_normal(part.normals[i]), colour});
    for (const std::uint32_t i : part.indices) mesh->indices.push_back(base + i);
  }
  return mesh;
}

ModelFile nodes_of(const tinygltf::Model& gltf) {
  const std::vector<std::uint32_t> colours = colours_of(gltf);
  std::map<int, MeshPtr> meshes;
  Mat4d up(0);  // y up to z up: (x, y, z) -> (x, -z, y)
  up[0][0] = 1, up[1][2] = 1, up[2][1] = -1, up[3][3] = 1;
  ModelFile nodes;
  bool any = false;
  for (const foliage::GltfNode& node : foliage::gltf_nodes(gltf)) {
    MeshPtr mesh;
    if (node.mesh >= 0) {
      MeshPtr& known = meshes[node.mesh];
      if (!known) known = mesh_of(foliage::gltf_mesh(gltf, node.mesh), colours);
      mesh = known;
      any = any || !mesh->indices.empty();
    }
    nodes.push_back({.parent = static_cast<NodeId>(node.parent + 1),
                     .placement = node.parent < 0 ? up * node.placement : node.placement,
                     .mesh = std::move(mesh),
                     .name = node.name});
  }
  if (!any) throw std::runtime_error("no triangles in its scene");
  return nodes;
}

ModelFile read_bytes(std::span<const unsigned char> bytes, const std::string& name,
                     const std::optional<std::filesystem::path>& folder) {
  try {
    foliage::FolderFiles files(folder, foliage::kMaxGltfBytes);
    return nodes_of(foliage::load_gltf(bytes, files));
  } catch (const std::exception& error) {
    throw std::runtime_error(name + ": " + error.what());
  }
}

}  // namespace

ModelFile read_model(const std::filesystem::path& file) {
  std::vector<unsigned char> bytes;
  try {
    bytes = foliage::read_file(file);
  } catch (const std::exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  return read_bytes(bytes, file.string(), file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
}

ModelFile read_model(std::span<const unsigned char> bytes, const std::string& name) {
  return read_bytes(bytes, name, std::nullopt);
}

NodeId add_model(Nodes& nodes, const ModelFile& model, NewNode as) {
  const NodeId root = nodes.add(std::move(as));
  std::vector<NodeId> ids;
  try {
    for (const NewNode& node : model) {
      NewNode copy = node;
      copy.parent = node.parent == 0 ? root : ids[node.parent - 1];
      ids.push_back(nodes.add(std::move(copy)));
    }
  } catch (...) {
    nodes.remove(root);
    throw;
  }
  return root;
}

}  // namespace manzana
