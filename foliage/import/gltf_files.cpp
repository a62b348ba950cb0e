#include "foliage/import/gltf_files.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "files/whole_file.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// tinygltf asks for a name relative to the folder, then for the same after "./", and takes no exceptions.
struct Sandbox {
  FolderFiles& files;
  std::string refusal = {};  // the first thing that was asked for and must not be read
};

bool file_exists(const std::string& name, void* user) {
  auto& sandbox = *static_cast<Sandbox*>(user);
  if (name.empty()) return false;
  try {
    return sandbox.files.find(name).has_value();
  } catch (const std::runtime_error& error) {
    if (sandbox.refusal.empty()) sandbox.refusal = error.what();
    return false;
  }
}

bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* user) {
  auto& sandbox = *static_cast<Sandbox*>(user);
  try {
    auto bytes = sandbox.files.read(name);
    if (!bytes) return false;
    *out = std::move(*bytes);
    return true;
  } catch (const std::exception& e) {
    if (sandbox.refusal.empty()) sandbox.refusal = e.what();
    if (error != nullptr) *error = e.what();
    return false;
  }
}

std::string as_it_is(const std::string& name, void*) { return name; }

/// tinygltf hands over a pointer into the buffer for images in buffer views: those are read later.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
  image->as_is = true;
  if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

std::uint32_t little_endian(std::span<const unsigned char> bytes, std::size_t at) {
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

bool is_binary(std::span<const unsigned char> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// The JSON text of either container. [glTF 2.0, section 4.4 GLB file format]
std::string_view json_text(std::span<const unsigned char> bytes) {
  std::size_t first = 0, length = bytes.size();
  if (is_binary(bytes)) {
    if (bytes.size() < 20) fail("cut off within the GLB header");
    if (const std::uint32_t version = little_endian(bytes, 4); version != 2)
      fail("GLB version " + std::to_string(version) + ", and only 2 is read");
    if (const std::uint32_t total = little_endian(bytes, 8); total > bytes.size())
      fail("cut off: the GLB header says " + std::to_string(total) + " bytes, there are " +
           std::to_string(bytes.size()));
    first = 20;
    length = little_endian(bytes, 12);
    if (little_endian(bytes, 16) != 0x4E4F534A) fail("the first chunk of the GLB is not JSON");
    if (length > bytes.size() - first) fail("the JSON chunk is longer than the file");
  }
  const auto text = bytes.subspan(first, length);
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

/// tinygltf reads `extras` by recursion.
void check_depth(std::string_view json) {
  constexpr int kDeepest = 64;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) fail("JSON nested deeper than " + std::to_string(kDeepest));
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

Json parse(std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    fail(std::string("not JSON: ") + error.what());
  }
}

void check_version(const Json& root) {
  const auto version = root.value(Json::json_pointer("/asset/version"), Json());
  if (!version.is_string() || !version.get<std::string>().starts_with("2.")) fail("asset.version is not 2.x");
}

void check_extensions(const Json& root) {
  static constexpr std::array<std::string_view, 3> kKnown{"KHR_mesh_quantization", "KHR_materials_unlit",
                                                          "KHR_materials_specular"};
  const auto found = root.find("extensionsRequired");
  if (found == root.end()) return;
  if (!found->is_array()) fail("extensionsRequired is not an array");
  for (const Json& item : *found) {
    const std::string name = item.is_string() ? item.get<std::string>() : item.dump();
    if (name == "KHR_draco_mesh_compression") fail("compressed by Draco (KHR_draco_mesh_compression): decode it first");
    if (std::find(kKnown.begin(), kKnown.end(), name) == kKnown.end()) fail("requires the unknown extension " + name);
  }
}

/// A count or an offset; `fallback` if it is absent.
std::uint64_t number(const Json& object, const char* key, const std::string& where,
                     std::optional<std::uint64_t> fallback) {
  const auto found = object.find(key);
  if (found == object.end()) {
    if (!fallback) fail(where + " has no " + key);
    return *fallback;
  }
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > kMaxGltfBytes)
    fail(where + ": " + key + " is " + found->dump());
  return found->get<std::uint64_t>();
}

/// The objects of a top-level array, each with its place for messages.
template <class Visit>
void each_object(const Json& root, const char* key, Visit&& visit) {
  const auto found = root.find(key);
  if (found == root.end()) return;
  if (!found->is_array()) fail(std::string(key) + " is not an array");
  for (std::size_t i = 0; i < found->size(); ++i) {
    const std::string where = std::string(key) + "[" + std::to_string(i) + "]";
    if (!(*found)[i].is_object()) fail(where + " is not an object");
    visit((*found)[i], where);
  }
}

/// Buffers in the BIN chunk are copied by tinygltf one by one: the sum is what they take.
void check_buffers(const Json& root) {
  std::vector<std::uint64_t> lengths;
  std::uint64_t sum = 0;
  each_object(root, "buffers", [&](const Json& buffer, const std::string& where) {
    lengths.push_back(number(buffer, "byteLength", where, std::nullopt));
    if (lengths.back() == 0) fail(where + ": byteLength is 0");
    sum += lengths.back();
    if (sum > kMaxGltfBytes) fail("more than " + std::to_string(kMaxGltfBytes >> 20) + " MiB of buffers");
  });
  each_object(root, "bufferViews", [&](const Json& view, const std::string& where) {
    const std::uint64_t buffer = number(view, "buffer", where, std::nullopt);
    if (buffer >= lengths.size()) fail(where + ": there is no buffer " + std::to_string(buffer));
    const std::uint64_t end = number(view, "byteOffset", where, 0) + number(view, "byteLength", where, std::nullopt);
    if (end > lengths[buffer] || number(view, "byteOffset", where, 0) >= lengths[buffer])
      fail(where + ": ends past its buffer");
    if (number(view, "byteStride", where, 0) > 252) fail(where + ": byteStride is over 252");
  });
  each_object(root, "accessors", [&](const Json& accessor, const std::string& where) {
    number(accessor, "byteOffset", where, 0);
    number(accessor, "count", where, std::nullopt);
  });
}

std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  constexpr std::size_t kLongest = 300;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  return text;
}

}  // namespace

std::vector<unsigned char> read_file(const fs::path& file) { return files::read_whole(file, kMaxGltfBytes); }

tinygltf::Model load_gltf(std::span<const unsigned char> bytes, FolderFiles& files) {
  if (bytes.size() > kMaxGltfBytes) fail("larger than " + std::to_string(kMaxGltfBytes >> 20) + " MiB");
  const std::string_view text = json_text(bytes);
  check_depth(text);
  const Json root = parse(text);
  if (!root.is_object()) fail("not a JSON object");
  check_version(root);
  check_extensions(root);
  check_buffers(root);
  Sandbox sandbox{files};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({file_exists, as_it_is, read_whole_file, nullptr, &sandbox});
  loader.SetImageLoader(keep_encoded, nullptr);
  tinygltf::Model model;
  std::string error, warning;
  const auto size = static_cast<unsigned int>(bytes.size());
  const bool good = is_binary(bytes) ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, "")
                                     : loader.LoadASCIIFromString(&model, &error, &warning, text.data(), size, "");
  if (!sandbox.refusal.empty()) fail(sandbox.refusal);
  if (!good || !error.empty()) fail(error.empty() ? "not readable as glTF" : one_line(error));
  for (const tinygltf::BufferView& view : model.bufferViews) {
    const auto buffer = static_cast<std::size_t>(view.buffer);
    if (buffer >= model.buffers.size() || view.byteOffset + view.byteLength > model.buffers[buffer].data.size())
      fail("a buffer view ends past its buffer");
  }
  return model;
}

tinygltf::Model load_gltf(std::span<const unsigned char> bytes, const std::optional<fs::path>& folder) {
  FolderFiles files(folder, kMaxGltfBytes);
  return load_gltf(bytes, files);
}

}  // namespace manzana::foliage
