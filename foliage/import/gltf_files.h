#pragma once
/// What stands between an untrusted glTF file and tinygltf: limits, the checks that tinygltf does not make, and file
/// access that cannot leave the file's folder. Messages have no file name yet; read_plant() puts it before them.
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "foliage/import/folder_files.h"

namespace tinygltf {
class Model;
}

namespace manzana::foliage {

inline constexpr std::uint64_t kMaxGltfBytes = 256U << 20;  // of the file, and of all buffers together

/// Reads a regular file of at most kMaxGltfBytes; throws std::runtime_error.
std::vector<unsigned char> read_file(const std::filesystem::path& file);

/// Buffers are among `files`, or within `bytes`.
/// Images are left encoded, in tinygltf::Image::image, or in their buffer view. Sure afterwards: every buffer view lies
/// within its buffer, and no extension is required that we do not know. Throws std::runtime_error.
tinygltf::Model load_gltf(std::span<const unsigned char> bytes, FolderFiles& files);
tinygltf::Model load_gltf(std::span<const unsigned char> bytes, const std::optional<std::filesystem::path>& folder);

}  // namespace manzana::foliage
