#pragma once
/// Values of glTF accessors as doubles and indices, with every bound checked: interleaved, normalised, sparse.
#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

namespace manzana::foliage {

inline constexpr std::size_t kMaxGltfElements = 4'000'000;  // of an accessor

/// `components` values an element (3 for VEC3). Throws std::runtime_error naming the accessor for another type, or
/// anything out of bounds. Integers are normalised if the accessor says so.
std::vector<double> read_values(const tinygltf::Model& model, int accessor, int components);

/// Scalars of an unsigned type.
std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace manzana::foliage
