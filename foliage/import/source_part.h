#pragma once
/// A plant's triangles as a model file has them, before it is known what they are. Made by the readers of glTF and OBJ,
/// turned into a Plant by assemble_plant.h.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "foliage/plant.h"

namespace manzana::foliage {

inline constexpr std::size_t kMaxSourceVertices = 2'000'000, kMaxSourceIndices = 6'000'000;  // of a file

enum class PlantPart : std::uint8_t { branch, leaf, flower, fruit };

struct SourceMaterial {
  std::string name;
  std::optional<PlantPart> told;  ///< by the file itself: extras
  bool cut_out = false;           ///< drawn with alpha
  std::function<Image()> image;   ///< what it wears, as plants wear it; called at most once, and only if it is needed
};

struct SourcePart {
  std::string name;               ///< of its mesh, node or group
  std::optional<PlantPart> told;  ///< by the file itself: extras
  int material = -1;              ///< -1: none; otherwise it exists
  std::vector<Vec3d> positions;   ///< z up, the file's units, finite
  std::vector<Vec3> normals;      ///< unit
  std::vector<Vec2> uvs;          ///< finite, below a million
  std::vector<std::uint32_t> indices;
  std::vector<std::int32_t> branch_ids;  ///< of vertices, not below 0; or none
};

/// For a part without: weighted by area; up where a vertex has no triangle.
std::vector<Vec3> computed_normals(const SourcePart& part);

}  // namespace manzana::foliage
