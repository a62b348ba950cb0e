#pragma once
/// How buildings and surfaces are painted: a shader for each way, and indices in their order, so that a run of objects
/// is one command for each and each shader is short: software devices run both sides of every branch.
///   PaintedIndices sorted = sort_by_paint(mesh, index_first);
#include <array>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "scenegraph/draw/instances.h"
#include "scenegraph/draw/renderer.h"
#include "scenegraph/scene.h"

namespace manzana::draw {

/// One fragment shader each.
enum class Paint : std::uint8_t { facade, roof, road, water, ground, picture, count };
inline constexpr std::size_t kPaints = static_cast<std::size_t>(Paint::count);
Paint paint_of(Material material);  ///< of what wears no picture

using PaintPrograms = std::array<gl::Program, kPaints>;
/// `photo`: the ground has one (photo_layer.h). `pictures`: some buildings wear some (picture_pages.h).
PaintPrograms make_paint_programs(bool photo, bool pictures);
/// Those of buildings, for what is between two levels: each sample of a pixel shows one of both.
PaintPrograms make_fading_programs(bool pictures);

/// Indices [first[p][i], first[p][i + 1]) of `indices` are object i's triangles of paint p.
struct PaintedIndices {
  std::vector<std::uint32_t> indices;
  std::array<std::vector<std::uint32_t>, kPaints> first;
};
PaintedIndices sort_by_paint(const CityMesh& mesh, std::span<const std::uint32_t> index_first);

/// For each vertex the number of lanes of the street it is part of: the largest v of its strip. 0 where not asphalt.
std::vector<std::uint8_t> count_lanes(const CityMesh& mesh);

}  // namespace manzana::draw
