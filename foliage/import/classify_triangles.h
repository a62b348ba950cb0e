#pragma once
/// What of a model is branch and what is leaf, flower or fruit: as its file says, else by shape.
#include <array>
#include <span>

#include "foliage/import/source_part.h"

namespace manzana::foliage {

/// Why a triangle was taken for what it was, the surest first.
enum class Reason : std::uint8_t {
  extras,      ///< an "organ" in the file's extras
  material,    ///< the material's name
  alpha,       ///< a material that is cut out by alpha
  name,        ///< the name of the mesh, node or group
  branch_ids,  ///< it has branch ids, or has none while others have
  shape,       ///< a piece that is a tube, or flat
  colour,      ///< of a piece whose shape does not tell: green or not
  rest         ///< nothing told: what is left over is branch, if leaves are known, or stands on the ground
};
inline constexpr std::size_t kReasons = 8;

/// Triangles by reason.
struct TakenFor {
  std::array<std::size_t, kReasons> branch{}, terminal{};
};

/// One of "branch", "leaf", "flower", "fruit", or what commonly stands for them within a name; none otherwise.
std::optional<PlantPart> part_by_name(std::string_view name);

/// All parts' triangles in one list.
struct TriangleList {
  std::vector<Vec3> positions;         ///< the foot of the plant at the origin
  std::vector<std::uint32_t> corners;  ///< of positions, three a triangle
  std::vector<std::uint32_t> joined;   ///< corners again, numbered alike where they lie at one place
  std::vector<std::uint32_t> source;   ///< of a triangle: its part
  std::vector<Vec2> uvs;               ///< as positions
};

/// Of each triangle. `images`: of the materials, drawn when they are first asked for.
struct Classified {
  std::vector<PlantPart> part;
  TakenFor taken;
};
Classified classify_triangles(const TriangleList& triangles, std::span<const SourcePart> parts,
                              std::span<const SourceMaterial> materials,
                              const std::function<const Image&(int material)>& image);

}  // namespace manzana::foliage
