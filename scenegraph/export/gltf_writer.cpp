#include "scenegraph/export/gltf_writer.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
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

int GltfWriter::external_buffer(const std::string& uri, std::size_t bytes) {
  external_.emplace_back(uri, bytes);
  return static_cast<int>(external_.size());
}

// tinygltf would put other buffers into the text; so they are named afterwards. The first begins behind 28 bytes and
// the text, and tables want it at a multiple of 8.
std::string GltfWriter::glb() {
  std::vector<unsigned char>& bytes = model.buffers[0].data;
  bytes.resize((bytes.size() + 7) / 8 * 8, 0);
  std::ostringstream out;
  if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, out, false, true))
    throw std::runtime_error("glTF could not be written");
  const std::string written = std::move(out).str();
  const auto word = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, written.data() + at, sizeof value);
    return value;
  };
  nlohmann::json json = nlohmann::json::parse(written.substr(20, word(12)));
  for (const auto& [uri, size] : external_) json["buffers"].push_back({{"uri", uri}, {"byteLength", size}});
  std::string text = json.dump();
  text.resize((text.size() + 3) / 8 * 8 + 4, ' ');
  const std::string rest = written.substr(20 + word(12));
  std::string all = written.substr(0, 20) + text + rest;
  const auto put = [&](std::size_t at, std::size_t value) {
    const auto number = static_cast<std::uint32_t>(value);
    std::memcpy(all.data() + at, &number, sizeof number);
  };
  put(8, all.size());
  put(12, text.size());
  return all;
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
