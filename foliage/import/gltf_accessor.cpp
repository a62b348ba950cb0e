#include "foliage/import/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

namespace manzana::foliage {
namespace {

/// Elements that lie in a buffer view; `data` is null for an accessor without one, which is all zeros.
struct Elements {
  const unsigned char* data = nullptr;
  std::size_t stride = 0, count = 0;
  int component_type = 0, components = 1;
  bool normalized = false;
};

[[noreturn]] void fail(int accessor, const std::string& what) {
  throw std::runtime_error("accessor " + std::to_string(accessor) + ": " + what);
}

std::size_t component_size(int accessor, int type) {
  const std::int32_t size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
  if (size <= 0 || type < TINYGLTF_COMPONENT_TYPE_BYTE || type > TINYGLTF_COMPONENT_TYPE_FLOAT ||
      type == TINYGLTF_COMPONENT_TYPE_INT)
    fail(accessor, "componentType " + std::to_string(type) + " does not exist");
  return static_cast<std::size_t>(size);
}

/// Points `out` at `offset` of the view, if all its elements lie there.
void place(const tinygltf::Model& model, int accessor, int view_index, std::uint64_t offset, Elements& out) {
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= model.bufferViews.size())
    fail(accessor, "there is no buffer view " + std::to_string(view_index));
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  const std::size_t element = component_size(accessor, out.component_type) * static_cast<std::size_t>(out.components);
  out.stride = view.byteStride != 0 ? view.byteStride : element;
  // 64 bits: a count of at most 4e6 times a stride of at most 252 cannot overflow.
  const std::uint64_t needed = out.count == 0 ? 0 : (out.count - 1) * std::uint64_t{out.stride} + element;
  if (offset > view.byteLength || needed > view.byteLength - offset) fail(accessor, "reads past its buffer view");
  out.data = model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset + offset;
}

const tinygltf::Accessor& accessor_at(const tinygltf::Model& model, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) fail(index, "does not exist");
  return model.accessors[static_cast<std::size_t>(index)];
}

Elements elements_of(const tinygltf::Model& model, int index, int components) {
  const tinygltf::Accessor& accessor = accessor_at(model, index);
  if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components ||
      accessor.type == TINYGLTF_TYPE_MAT2)
    fail(index, "has not the type that its use asks for");
  if (accessor.count > kMaxGltfElements) fail(index, "has more than " + std::to_string(kMaxGltfElements) + " elements");
  component_size(index, accessor.componentType);
  Elements out{nullptr, 0, accessor.count, accessor.componentType, components, accessor.normalized};
  if (accessor.bufferView >= 0) place(model, index, accessor.bufferView, accessor.byteOffset, out);
  return out;
}

template <class T>
double value_as(const unsigned char* at, bool normalized) {
  T value;
  std::memcpy(&value, at, sizeof value);  // may be unaligned
  if (!normalized || std::is_floating_point_v<T>) return static_cast<double>(value);
  // [glTF 2.0, section 3.11] signed: max(c / max, -1)
  return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double value_at(const Elements& e, std::size_t element, std::size_t component) {
  if (e.data == nullptr) return 0;
  const unsigned char* at = e.data + element * e.stride;
  switch (e.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return value_as<std::int8_t>(at + component, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return value_as<std::uint8_t>(at + component, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return value_as<std::int16_t>(at + 2 * component, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return value_as<std::uint16_t>(at + 2 * component, e.normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return value_as<std::uint32_t>(at + 4 * component, e.normalized);
    default:
      return value_as<float>(at + 4 * component, false);
  }
}

/// Sparse elements over the others. [glTF 2.0, section 3.6.2.3]
void overlay(const tinygltf::Model& model, int index, int components, std::vector<double>& values) {
  const tinygltf::Accessor& accessor = accessor_at(model, index);
  const auto& sparse = accessor.sparse;
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0)
    fail(index, "its sparse part is out of range");
  const auto count = static_cast<std::size_t>(sparse.count);
  Elements at{nullptr, 0, count, sparse.indices.componentType, 1, false};
  Elements with{nullptr, 0, count, accessor.componentType, components, accessor.normalized};
  place(model, index, sparse.indices.bufferView, static_cast<std::uint64_t>(sparse.indices.byteOffset), at);
  place(model, index, sparse.values.bufferView, static_cast<std::uint64_t>(sparse.values.byteOffset), with);
  for (std::size_t i = 0; i < count; ++i) {
    const double element = value_at(at, i, 0);
    if (!(element >= 0 && element < static_cast<double>(accessor.count))) fail(index, "a sparse index is out of range");
    for (std::size_t c = 0; c < static_cast<std::size_t>(components); ++c)
      values[static_cast<std::size_t>(element) * static_cast<std::size_t>(components) + c] = value_at(with, i, c);
  }
}

}  // namespace

std::vector<double> read_values(const tinygltf::Model& model, int accessor, int components) {
  const Elements elements = elements_of(model, accessor, components);
  const auto each = static_cast<std::size_t>(components);
  std::vector<double> values(elements.count * each);
  for (std::size_t i = 0; i < elements.count; ++i)
    for (std::size_t c = 0; c < each; ++c) values[i * each + c] = value_at(elements, i, c);
  if (model.accessors[static_cast<std::size_t>(accessor)].sparse.isSparse) overlay(model, accessor, components, values);
  return values;
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor) {
  const int type = accessor_at(model, accessor).componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    fail(accessor, "indices are not of an unsigned type");
  const std::vector<double> values = read_values(model, accessor, 1);
  std::vector<std::uint32_t> indices;
  indices.reserve(values.size());
  for (const double value : values) {
    if (!(value >= 0 && value <= 4294967295.0)) fail(accessor, "an index is out of range");
    indices.push_back(static_cast<std::uint32_t>(value));
  }
  return indices;
}

}  // namespace manzana::foliage
