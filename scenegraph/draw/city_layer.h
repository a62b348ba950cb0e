#pragma once
/// Buildings and surfaces on the GPU. A layer's indices are kept once for each way of painting, in the order of the
/// objects, so that a run of objects is one command for each paint and each shader is short: software devices run both
/// sides of every branch.
///   const PreparedLayer prepared = prepare_layer(scene.buildings);   // no GL
///   CityLayer layer(prepared, uploads);
///   draw_city(layer, paints, objects, stream);                       // once it is uploaded
#include <array>
#include <span>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/uploads.h"
#include "scenegraph/draw/instances.h"
#include "scenegraph/draw/renderer.h"
#include "scenegraph/scene.h"

namespace manzana::draw {

/// One fragment shader each.
enum class Paint : std::uint8_t { facade, roof, road, water, ground, count };
inline constexpr std::size_t kPaints = static_cast<std::size_t>(Paint::count);
Paint paint_of(Material material);

using PaintPrograms = std::array<gl::Program, kPaints>;
PaintPrograms make_paint_programs();

/// Indices [first[p][i], first[p][i + 1]) of `indices` are object i's triangles of paint p.
struct PaintedIndices {
  std::vector<std::uint32_t> indices;
  std::array<std::vector<std::uint32_t>, kPaints> first;
};
PaintedIndices sort_by_paint(const CityMesh& mesh, std::span<const std::uint32_t> index_first);

/// For each vertex the number of lanes of the street it is part of: the largest v of its strip. 0 where not asphalt.
std::vector<std::uint8_t> count_lanes(const CityMesh& mesh);

/// Commands for the runs, adjacent ones merged; returns how many. `out` has room for runs.size().
Drawn make_commands(std::span<const std::uint32_t> first, std::span<const culling::ObjectRun> runs,
                    gl::DrawCommand* out);

/// A layer as the GPU will have it.
struct PreparedLayer {
  std::vector<CityVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::array<std::vector<std::uint32_t>, kPaints> first;  ///< a row an object of the tree, and one more
};
/// Throws std::runtime_error for more than 2^24 blocks.
PreparedLayer prepare_layer(const MeshLayer& layer);

struct CityLayer {
  /// `prepared` must stay until it is uploaded.
  CityLayer(const PreparedLayer& prepared, gl::Uploads& uploads);
  gl::VertexArray array;
  gl::Buffer vertices, indices;
  std::array<std::vector<std::uint32_t>, kPaints> first;
  std::vector<std::uint32_t> painted;  ///< a row an object of the layer, once some have colours that are not their own
};
/// Of `from`, in which no vertex is two objects'; 0xRRGGBB a row, kOwnColour: as it was. Materials stay. Only what
/// changes is uploaded.
void repaint(CityLayer& layer, const MeshLayer& from, std::span<const std::uint32_t> colours);

std::size_t stream_bytes(const CityLayer& layer, std::size_t runs);
/// `objects`: runs of the tree's.
Drawn draw_city(const CityLayer& layer, const PaintPrograms& paints, std::span<const culling::ObjectRun> objects,
                gl::StreamBuffer& stream);

}  // namespace manzana::draw
