#include "scenegraph/export/gltf_writer.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace manzana {

using tinygltf::Value;

tinygltf::Value gltf_object(std::initializer_list<std::pair<const std::string, Value>> members) {
  return Value(Value::Object(members));
}

GltfWriter::GltfWriter() {
  model.asset.version = "2.0";
  model.asset.generator = "Manzana";
  model.buffers.resize(1);
}

int GltfWriter::view(const void* data, std::size_t size, int target) {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  bytes.resize((bytes.size() + 7) / 8 * 8, 0);
  tinygltf::BufferView out;
  out.buffer = 0;
  out.byteOffset = bytes.size();
  out.byteLength = size;
  out.target = target;
  const auto* first = static_cast<const unsigned char*>(data);
  bytes.insert(bytes.end(), first, first + size);
  model.bufferViews.push_back(std::move(out));
  return static_cast<int>(model.bufferViews.size() - 1);
}

void GltfWriter::use_extension(const std::string& name, bool required) {
  const auto add = [&](std::vector<std::string>& list) {
    if (std::ranges::find(list, name) == list.end()) list.push_back(name);
  };
  add(model.extensionsUsed);
  if (required) add(model.extensionsRequired);
}

std::string GltfWriter::written() const {
  std::ostringstream out;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, true))
    throw std::runtime_error("glTF could not be written");
  return std::move(out).str();
}

std::string GltfWriter::glb() {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  bytes.resize((bytes.size() + 7) / 8 * 8, 0);
  std::string all = written();
  // The buffer begins behind 28 bytes and the text, padded to 4; tables want it at a multiple of 8.
  const auto text = static_cast<unsigned char>(all[12]);
  if (text % 8 == 4) return all;
  model.asset.generator.append(4, ' ');
  return written();
}

PropertyTable::PropertyTable(GltfWriter& out, std::string name, std::size_t rows)
    : out_(out), name_(std::move(name)), rows_(rows) {}

void PropertyTable::add(const std::string& property, const std::vector<std::string>& column) {
  std::string all;
  std::vector<std::uint32_t> offsets{0};
  for (const std::string& text : column) {
    all += text;
    offsets.push_back(static_cast<std::uint32_t>(all.size()));
  }
  if (all.empty()) all.push_back(' ');  // a view has at least one byte
  types_[property] = gltf_object({{"type", gltf_text("STRING")}, {"required", Value(true)}});
  columns_[property] = gltf_object({{"values", Value(out_.view(std::span<const char>(all)))},
                                    {"stringOffsets", Value(out_.view(std::span<const std::uint32_t>(offsets)))},
                                    {"stringOffsetType", gltf_text("UINT32")}});
}

void PropertyTable::add(const std::string& property, const std::vector<float>& column, const std::string& description) {
  types_[property] = gltf_object({{"type", gltf_text("SCALAR")},
                                  {"componentType", gltf_text("FLOAT32")},
                                  {"description", gltf_text(description)},
                                  {"required", Value(true)}});
  columns_[property] = gltf_object({{"values", Value(out_.view(std::span(column)))}});
}

Value PropertyTable::schema_class() const { return gltf_object({{"properties", Value(types_)}}); }

Value PropertyTable::table() const {
  return gltf_object({{"class", gltf_text(name_)},
                      {"name", gltf_text(name_)},
                      {"count", Value(static_cast<int>(rows_))},
                      {"properties", Value(columns_)}});
}

void set_metadata(GltfWriter& out, const std::vector<PropertyTable>& tables) {
  if (tables.empty()) return;
  Value::Object classes;
  Value::Array rows;
  for (const PropertyTable& table : tables) {
    classes[table.name()] = table.schema_class();
    rows.push_back(table.table());
  }
  out.use_extension("EXT_structural_metadata");
  out.model.extensions["EXT_structural_metadata"] =
      gltf_object({{"schema", gltf_object({{"id", gltf_text("manzana")}, {"classes", Value(classes)}})},
                   {"propertyTables", Value(rows)}});
}

}  // namespace manzana
