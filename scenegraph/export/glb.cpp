#include "scenegraph/export/glb.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenegraph/export/gltf_writer.h"

namespace manzana {

struct SharedModel {
  std::vector<tinygltf::BufferView> views;
  std::vector<tinygltf::Accessor> accessors;
  tinygltf::Primitive primitive;
};

namespace {

using tinygltf::Value;

/// glTF is y-up: viewers turn (x, y, z) into (x, -z, y).
void put(std::vector<float>& out, const Vec3& v) { out.insert(out.end(), {v.x, v.z, -v.y}); }

void put_colour(std::vector<std::uint16_t>& out, const Vec3& linear) {
  for (int i = 0; i < 3; ++i)
    out.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(linear[i], 0.0F, 1.0F) * 65535)));
  out.push_back(65535);
}

template <class T>
int index_accessor(GltfWriter& out, const TileMesh& mesh) {
  const std::vector<T> indices(mesh.indices.begin(), mesh.indices.end());
  return out.accessor(indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
}

tinygltf::Primitive encode(GltfWriter& out, const TileMesh& mesh) {
  std::vector<float> positions, normals;
  std::vector<std::uint16_t> colours;
  for (const TileMesh::Vertex& v : mesh.vertices) {
    put(positions, v.position);
    put(normals, v.normal);
    put_colour(colours, v.colour);
  }
  constexpr int kTarget = TINYGLTF_TARGET_ARRAY_BUFFER;
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.material = 0;
  primitive.attributes["POSITION"] = out.accessor(positions, TINYGLTF_TYPE_VEC3, kTarget, true);
  primitive.attributes["NORMAL"] = out.accessor(normals, TINYGLTF_TYPE_VEC3, kTarget);
  primitive.attributes["COLOR_0"] = out.accessor(colours, TINYGLTF_TYPE_VEC4, kTarget);
  out.model.accessors.back().normalized = true;
  primitive.indices = mesh.vertices.size() < 65535 ? index_accessor<std::uint16_t>(out, mesh)
                                                   : index_accessor<std::uint32_t>(out, mesh);
  return primitive;
}

/// The views and accessors of another model, whose buffer is a file here.
tinygltf::Primitive take_over(GltfWriter& out, const SharedModel& other, const std::string& uri, std::size_t bytes) {
  tinygltf::Primitive primitive = other.primitive;
  const int buffer = out.external_buffer(uri, bytes);
  const int views = static_cast<int>(out.model.bufferViews.size()),
            accessors = static_cast<int>(out.model.accessors.size());
  for (tinygltf::BufferView view : other.views) {
    view.buffer = buffer;
    out.model.bufferViews.push_back(std::move(view));
  }
  for (tinygltf::Accessor accessor : other.accessors) {
    accessor.bufferView += views;
    out.model.accessors.push_back(std::move(accessor));
  }
  for (auto& [name, index] : primitive.attributes) index += accessors;
  primitive.indices += accessors;
  return primitive;
}

Value feature_ids(std::size_t count, const char* label) {
  Value::Array sets;
  sets.push_back(gltf_object({{"featureCount", Value(static_cast<int>(count))},
                              {"attribute", Value(0)},
                              {"propertyTable", Value(0)},
                              {"label", gltf_text(label)}}));
  return gltf_object({{"featureIds", Value(sets)}});
}

class Encoder {
 public:
  explicit Encoder(const std::string& attribution) { out_.model.asset.copyright = attribution; }

  EncodedTile city(const TileContent& content) {
    if (!content.ground_mesh.indices.empty()) add_ground(content.ground_mesh);
    if (!content.buildings_mesh.indices.empty()) add_buildings(content.buildings_mesh, content.buildings);
    return finish();
  }

  EncodedTile trees(const std::map<std::uint16_t, std::vector<TreeRow>>& trees, const TreeModels& models) {
    if (!trees.empty()) add_all_trees(trees, models);
    return finish();
  }

 private:
  EncodedTile finish() {
    if (out_.model.nodes.empty()) return {};
    set_metadata(out_, tables_);
    out_.model.scenes.resize(1);
    out_.model.defaultScene = 0;
    for (std::size_t i = 0; i < out_.model.nodes.size(); ++i) out_.model.scenes[0].nodes.push_back(static_cast<int>(i));
    return {out_.glb(), with_room()};
  }

  void add_material(const std::string& name, bool both_sides) {
    tinygltf::Material material;
    material.name = name;
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 1;
    material.doubleSided = both_sides;
    out_.model.materials.push_back(std::move(material));
  }
  // The one material of the file.
  tinygltf::Primitive primitive_of(const TileMesh& mesh, bool both_sides) {
    if (out_.model.materials.empty()) add_material(both_sides ? "plant" : "city", both_sides);
    return encode(out_, mesh);
  }

  tinygltf::Primitive primitive_of(const TreeModel& model) {
    if (model.uri.empty()) return primitive_of(model.mesh, true);
    if (out_.model.materials.empty()) add_material("plant", true);
    return take_over(out_, *model.parts, model.uri, model.bytes.size());
  }

  void add_node(const std::string& name, tinygltf::Primitive primitive, tinygltf::ExtensionMap extensions = {}) {
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(std::move(primitive));
    tinygltf::Node node;
    node.name = name;
    node.mesh = static_cast<int>(out_.model.meshes.size());
    node.extensions = std::move(extensions);
    out_.model.meshes.push_back(std::move(mesh));
    out_.model.nodes.push_back(std::move(node));
  }

  void enclose(const TileMesh& mesh) {
    for (const TileMesh::Vertex& v : mesh.vertices) box_ = merge(box_, Vec3d(v.position));
  }

  void add_ground(const TileMesh& mesh) {
    enclose(mesh);
    add_node("ground", primitive_of(mesh, false));
  }

  void add_buildings(const TileMesh& mesh, const std::vector<BuildingRow>& rows) {
    enclose(mesh);
    tinygltf::Primitive primitive = primitive_of(mesh, false);
    std::vector<float> features;
    for (const TileMesh::Vertex& v : mesh.vertices) features.push_back(static_cast<float>(v.feature));
    primitive.attributes["_FEATURE_ID_0"] = out_.accessor(features, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ARRAY_BUFFER);
    out_.use_extension("EXT_mesh_features");
    primitive.extensions["EXT_mesh_features"] = feature_ids(rows.size(), "building");
    add_node("buildings", std::move(primitive));
    add_table(rows);
  }

  void add_table(const std::vector<BuildingRow>& rows) {
    std::vector<std::string> ids, sources, names, kinds;
    std::vector<float> heights;
    for (const BuildingRow& row : rows) {
      ids.push_back(row.id);
      sources.push_back(row.source);
      names.push_back(row.name);
      kinds.push_back(row.kind);
      heights.push_back(row.height_m);
    }
    PropertyTable table(out_, "building", rows.size());
    table.add("id", ids);
    table.add("source_id", sources);
    table.add("name", names);
    table.add("class", kinds);
    table.add("height", heights, "metres");
    tables_.push_back(std::move(table));
  }

  // A node a plant, since instances share a mesh; rows of one table, in the order of the nodes.
  void add_all_trees(const std::map<std::uint16_t, std::vector<TreeRow>>& all, const TreeModels& models) {
    std::size_t count = 0;
    for (const auto& [plant, trees] : all) count += trees.size();
    std::vector<std::string> species, sources;
    std::vector<float> heights, crowns;
    for (const auto& [plant, trees] : all) {
      add_trees(models.at(plant), trees, species.size(), count);
      for (const TreeRow& tree : trees) {
        species.push_back(models.at(plant).species);
        sources.push_back(tree.source);
        heights.push_back(tree.height_m);
        crowns.push_back(tree.crown_m);
      }
    }
    PropertyTable table(out_, "tree", count);
    table.add("source_id", sources);
    table.add("species", species);
    table.add("height", heights, "metres");
    table.add("crown", crowns, "diameter, metres");
    tables_.push_back(std::move(table));
    out_.use_extension("EXT_mesh_gpu_instancing", true);
    out_.use_extension("EXT_instance_features");
  }

  void add_trees(const TreeModel& model, const std::vector<TreeRow>& trees, std::size_t first, std::size_t count) {
    std::vector<float> feet, turns, scales, features;
    for (const TreeRow& tree : trees) {
      put(feet, tree.foot);
      turns.insert(turns.end(), {tree.turn.x, tree.turn.z, -tree.turn.y, tree.turn.w});
      scales.insert(scales.end(), {tree.scale.x, tree.scale.z, tree.scale.y});
      features.push_back(static_cast<float>(first + features.size()));
      enclose(model.mesh, tree);
    }
    Value::Object attributes;
    attributes["TRANSLATION"] = Value(out_.accessor(feet, TINYGLTF_TYPE_VEC3, 0, true));
    attributes["ROTATION"] = Value(out_.accessor(turns, TINYGLTF_TYPE_VEC4));
    attributes["SCALE"] = Value(out_.accessor(scales, TINYGLTF_TYPE_VEC3));
    attributes["_FEATURE_ID_0"] = Value(out_.accessor(features, TINYGLTF_TYPE_SCALAR));
    tinygltf::ExtensionMap extensions;
    extensions["EXT_mesh_gpu_instancing"] = gltf_object({{"attributes", Value(attributes)}});
    extensions["EXT_instance_features"] = feature_ids(count, "tree");
    add_node(model.species, primitive_of(model), std::move(extensions));
  }

  void enclose(const TileMesh& model, const TreeRow& tree) {
    const Mat3 axes = glm::mat3_cast(tree.turn);
    for (const TileMesh::Vertex& v : model.vertices)
      box_ = merge(box_, Vec3d(tree.foot + axes * (v.position * tree.scale)));
  }

  /// What a viewer computes in float is off by some units in the last place of the largest coordinate.
  culling::BoxD with_room() const {
    if (box_.empty()) return box_;
    const Vec3d far = glm::max(glm::abs(box_.min), glm::abs(box_.max));
    const double room = 1e-6 * std::max({far.x, far.y, far.z, 100.0});
    return {box_.min - room, box_.max + room};
  }

  GltfWriter out_;
  std::vector<PropertyTable> tables_;
  culling::BoxD box_;
};

}  // namespace

TreeModel share(TreeModel model, const std::string& uri) {
  GltfWriter shared;
  const tinygltf::Primitive primitive = encode(shared, model.mesh);
  model.parts = std::make_shared<SharedModel>(SharedModel{shared.model.bufferViews, shared.model.accessors, primitive});
  const std::vector<unsigned char>& bytes = shared.model.buffers[0].data;
  model.bytes.assign(bytes.begin(), bytes.end());
  model.uri = uri;
  return model;
}

EncodedTile encode_city(const TileContent& content, const std::string& attribution) {
  return Encoder(attribution).city(content);
}

EncodedTile encode_trees(const TileContent& content, const TreeModels& models, const std::string& attribution) {
  return Encoder(attribution).trees(content.trees, models);
}

}  // namespace manzana
