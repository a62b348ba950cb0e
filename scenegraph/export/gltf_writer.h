#pragma once
/// Builds a glTF model: each list gets a view of its own of the first buffer, from a multiple of 8 bytes on, as
/// EXT_structural_metadata wants it. Other buffers lie in files beside.
///   GltfWriter out;
///   const int positions = out.accessor(points, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
///   std::string glb = out.glb();
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <tiny_gltf.h>

#include "culling/vec.h"

namespace manzana {

template <class T>
constexpr int gltf_component() {
  if constexpr (std::is_same_v<T, float>) return TINYGLTF_COMPONENT_TYPE_FLOAT;
  if constexpr (std::is_same_v<T, std::uint16_t>) return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

class GltfWriter {
 public:
  tinygltf::Model model;

  GltfWriter();
  int view(const void* data, std::size_t size, int target = 0);
  template <class T>
  int view(std::span<const T> list, int target = 0) {
    return view(list.data(), list.size_bytes(), target);
  }
  /// Of components one after the other; with their bounds where the format asks for them.
  template <class T>
  int accessor(const std::vector<T>& components, int type, int target = 0, bool bounds = false) {
    tinygltf::Accessor out;
    out.bufferView = view(std::span(components), target);
    out.componentType = gltf_component<T>();
    out.type = type;
    const auto width = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type)));
    out.count = components.size() / width;
    for (std::size_t i = 0; bounds && i < components.size(); ++i) {
      const auto value = static_cast<double>(components[i]);
      if (i < width) out.minValues.push_back(value), out.maxValues.push_back(value);
      out.minValues[i % width] = std::min(out.minValues[i % width], value);
      out.maxValues[i % width] = std::max(out.maxValues[i % width], value);
    }
    model.accessors.push_back(std::move(out));
    return static_cast<int>(model.accessors.size() - 1);
  }
  /// Of a file: its number.
  int external_buffer(const std::string& uri, std::size_t bytes);
  void use_extension(const std::string& name, bool required = false);
  std::string glb();

 private:
  std::vector<std::pair<std::string, std::size_t>> external_;  // buffers from 1 on: URI, bytes
};

/// {"a": 1, "b": "x"} of tinygltf.
tinygltf::Value gltf_object(std::initializer_list<std::pair<const std::string, tinygltf::Value>> members);
inline tinygltf::Value gltf_text(const std::string& text) { return tinygltf::Value(text); }

/// Rows of equal classes, a column a property.
class PropertyTable {
 public:
  PropertyTable(GltfWriter& out, std::string name, std::size_t rows);
  void add(const std::string& property, const std::vector<std::string>& column);
  void add(const std::string& property, const std::vector<float>& column, const std::string& unit);
  tinygltf::Value schema_class() const;
  tinygltf::Value table() const;
  const std::string& name() const { return name_; }

 private:
  GltfWriter& out_;
  std::string name_;
  std::size_t rows_;
  tinygltf::Value::Object types_, columns_;
};

/// EXT_structural_metadata of the model.
void set_metadata(GltfWriter& out, const std::vector<PropertyTable>& tables);

}  // namespace manzana
