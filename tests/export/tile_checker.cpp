#include "tests/export/tile_checker.h"

#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace manzana {
namespace {

using Json = nlohmann::json;
using tinygltf::Value;

constexpr double kRounding = 1e-6;  // metres: of doubles, through a few transforms within a city

class Decoder {
 public:
  explicit Decoder(const std::filesystem::path& file) {
    std::string error, warning;
    if (!tinygltf::TinyGLTF().LoadBinaryFromFile(&model_, &error, &warning, file))
      throw std::runtime_error(file.string() + ": " + error);
  }

  DecodedContent run() {
    read_tables();
    for (const int node : model_.scenes.at(0).nodes) add_node(model_.nodes.at(static_cast<std::size_t>(node)));
    return std::move(out_);
  }

 private:
  template <class T>
  std::vector<T> list_of(int view) const {
    const tinygltf::BufferView& v = model_.bufferViews.at(static_cast<std::size_t>(view));
    std::vector<T> list(v.byteLength / sizeof(T));
    std::memcpy(list.data(), model_.buffers.at(static_cast<std::size_t>(v.buffer)).data.data() + v.byteOffset,
                list.size() * sizeof(T));
    return list;
  }
  const tinygltf::Accessor& accessor(int index) const { return model_.accessors.at(static_cast<std::size_t>(index)); }
  std::vector<float> floats(int index) const {
    if (accessor(index).componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) throw std::runtime_error("not floats");
    return list_of<float>(accessor(index).bufferView);
  }
  std::vector<std::uint32_t> indices_of(int index) const {
    if (accessor(index).componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
      return list_of<std::uint32_t>(accessor(index).bufferView);
    const auto small = list_of<std::uint16_t>(accessor(index).bufferView);
    return {small.begin(), small.end()};
  }

  void read_tables() {
    if (!model_.extensions.contains("EXT_structural_metadata")) return;
    const Value& tables = model_.extensions.at("EXT_structural_metadata").Get("propertyTables");
    for (int t = 0; t < static_cast<int>(tables.ArrayLen()); ++t) {
      const std::string name = tables.Get(t).Get("class").Get<std::string>();
      rows_.push_back(tables.Get(t).Get("count").GetNumberAsInt());
      for (const std::string& property : tables.Get(t).Get("properties").Keys())
        read_column(name + "." + property, tables.Get(t).Get("properties").Get(property), rows_.back());
    }
  }
  void read_column(const std::string& name, const Value& column, int rows) {
    const int values = column.Get("values").GetNumberAsInt();
    if (!column.Has("stringOffsets")) {
      out_.numbers[name] = list_of<float>(values);
      if (out_.numbers[name].size() != static_cast<std::size_t>(rows)) fault(name + " has not a value a row");
      return;
    }
    const auto offsets = list_of<std::uint32_t>(column.Get("stringOffsets").GetNumberAsInt());
    const auto bytes = list_of<char>(values);
    for (int i = 0; i < rows; ++i) {
      const std::size_t first = offsets.at(static_cast<std::size_t>(i)),
                        last = offsets.at(static_cast<std::size_t>(i) + 1);
      out_.texts[name].emplace_back(bytes.data() + first, last - first);
    }
  }

  struct Instance {
    Vec3d foot{0};
    glm::dquat turn{1, 0, 0, 0};
    Vec3d scale{1};
  };

  std::vector<Instance> instances_of(const tinygltf::Node& node) {
    if (!node.extensions.contains("EXT_mesh_gpu_instancing")) return {Instance{}};
    const Value& attributes = node.extensions.at("EXT_mesh_gpu_instancing").Get("attributes");
    const auto of = [&](const char* name) { return floats(attributes.Get(name).GetNumberAsInt()); };
    const auto feet = of("TRANSLATION"), turns = of("ROTATION"), scales = of("SCALE"), features = of("_FEATURE_ID_0");
    std::vector<Instance> all(features.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].foot = {feet.at(3 * i), feet.at(3 * i + 1), feet.at(3 * i + 2)};
      all[i].turn = {turns.at(4 * i + 3), turns.at(4 * i), turns.at(4 * i + 1), turns.at(4 * i + 2)};
      all[i].scale = {scales.at(3 * i), scales.at(3 * i + 1), scales.at(3 * i + 2)};
      if (std::abs(glm::length(all[i].turn) - 1) > 1e-5) fault("a rotation is none");
      check_feature(node.extensions.at("EXT_instance_features"), features[i]);
    }
    out_.instances += all.size();
    return all;
  }

  void check_feature(const Value& extension, float feature) {
    const Value& set = extension.Get("featureIds").Get(0);
    const int table = set.Get("propertyTable").GetNumberAsInt();
    if (!(feature >= 0 && feature < static_cast<float>(rows_.at(static_cast<std::size_t>(table)))))
      fault("a feature id is no row of its table");
  }

  void add_node(const tinygltf::Node& node) {
    if (!node.matrix.empty() || !node.translation.empty() || !node.rotation.empty() || !node.scale.empty())
      fault("a node has a matrix of its own");
    const std::vector<Instance> instances = instances_of(node);
    for (const tinygltf::Primitive& primitive : model_.meshes.at(static_cast<std::size_t>(node.mesh)).primitives)
      for (const Instance& instance : instances) add(primitive, instance);
  }

  void add(const tinygltf::Primitive& primitive, const Instance& instance) {
    const auto positions = floats(primitive.attributes.at("POSITION"));
    const auto indices = indices_of(primitive.indices);
    const bool named = primitive.extensions.contains("EXT_mesh_features");
    const auto features = named ? floats(primitive.attributes.at("_FEATURE_ID_0")) : std::vector<float>();
    for (const float feature : features) check_feature(primitive.extensions.at("EXT_mesh_features"), feature);
    std::vector<Vec3d> placed;
    for (std::size_t i = 0; i + 2 < positions.size(); i += 3) {
      const Vec3d p(positions[i], positions[i + 1], positions[i + 2]);
      const Vec3d q = instance.foot + instance.turn * (instance.scale * p);
      placed.emplace_back(q.x, -q.z, q.y);
    }
    auto& triangles = named ? out_.buildings : out_.others;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      triangles.push_back({{placed.at(indices[i]), placed.at(indices[i + 1]), placed.at(indices[i + 2])},
                           named ? static_cast<int>(features.at(indices[i])) : -1});
    out_.vertices.insert(out_.vertices.end(), placed.begin(), placed.end());
  }

  void fault(const std::string& what) { out_.faults.push_back(what); }

  tinygltf::Model model_;
  DecodedContent out_;
  std::vector<int> rows_;
};

/// As in the file: a sphere, or a box with half axes.
struct Volume {
  Vec3d center{0};
  double radius = -1;  // >= 0: a sphere
  Mat3d half{0};

  bool holds(const Vec3d& p, double room) const {
    if (radius >= 0) return glm::distance(p, center) <= radius + room;
    for (int i = 0; i < 3; ++i) {
      const double length = glm::length(half[i]);
      if (std::abs(glm::dot(p - center, half[i] / length)) > length + room) return false;
    }
    return true;
  }
};

Volume volume_of(const Json& json) {
  Volume volume;
  const bool sphere = json.contains("sphere");
  const auto n = (sphere ? json.at("sphere") : json.at("box")).get<std::vector<double>>();
  volume.center = {n.at(0), n.at(1), n.at(2)};
  if (sphere) return volume.radius = n.at(3), volume;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) volume.half[i][k] = n.at(static_cast<std::size_t>(3 + 3 * i + k));
  return volume;
}

Mat4d transform_of(const Json& tile) {
  Mat4d m(1);
  if (!tile.contains("transform")) return m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = tile.at("transform").at(static_cast<std::size_t>(i)).get<double>();
  return m;
}

class Checker {
 public:
  explicit Checker(std::filesystem::path folder) : folder_(std::move(folder)) {}
  CheckedTiles run() {
    std::ifstream in(folder_ / "tileset.json");
    const Json tileset = Json::parse(in);
    if (tileset.at("asset").at("version") != "1.1") fault("is not 3D Tiles 1.1");
    const Json& root = tileset.at("root");
    if (!root.contains("contents")) fault("the root has no content");
    check(root, nullptr, tileset.at("geometricError"));
    return std::move(checked_);
  }

 private:
  void check(const Json& tile, const Volume* parent, double parent_error) {
    ++checked_.tiles;
    const Volume volume = volume_of(tile.at("boundingVolume"));
    const double error = tile.at("geometricError");
    if (error > parent_error) fault("a tile's error is more than its parent's");
    if (parent != nullptr) check_inside(volume, transform_of(tile), *parent);
    for (const Json& content : tile.value("contents", Json::array())) check_content(content.at("uri"), volume);
    const bool leaf = !tile.contains("children");
    if (leaf == (volume.radius >= 0)) fault("leaves have boxes, others spheres");
    if (leaf) return;
    for (const Json& child : tile.at("children")) check(child, &volume, error);
  }

  void check_inside(const Volume& volume, const Mat4d& to_parent, const Volume& parent) {
    const auto moved = [&](const Vec3d& p) { return Vec3d(to_parent * Vec4d(p, 1)); };
    bool inside = true;
    if (volume.radius >= 0) {
      inside = parent.radius >= 0 &&
               glm::distance(moved(volume.center), parent.center) + volume.radius <= parent.radius + kRounding;
    } else {
      for (unsigned i = 0; i < 8; ++i) {
        const Vec3d sign((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
        inside = inside && parent.holds(moved(volume.center + volume.half * sign), kRounding);
      }
    }
    if (!inside) fault("a tile's volume is not within its parent's");
  }

  void check_content(const std::string& uri, const Volume& volume) {
    const DecodedContent content = decode_content(folder_ / uri);
    ++checked_.contents;
    checked_.instances += content.instances;
    checked_.vertices += content.vertices.size();
    for (const auto& [name, column] : content.numbers)
      if (name.ends_with(".height")) checked_.features += column.size();
    for (const std::string& what : content.faults) fault(uri + ": " + what);
    for (const Vec3d& p : content.vertices)
      if (!volume.holds(p, 0)) return fault(uri + ": a vertex is outside its tile's volume");
  }

  void fault(const std::string& what) { checked_.faults.push_back(what); }

  std::filesystem::path folder_;
  CheckedTiles checked_;
};

}  // namespace

DecodedContent decode_content(const std::filesystem::path& glb) { return Decoder(glb).run(); }

CheckedTiles check_tiles(const std::filesystem::path& folder) { return Checker(folder).run(); }

}  // namespace manzana
