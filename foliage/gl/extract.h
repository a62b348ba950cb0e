#pragma once
/// From the trees in view to the lists that are drawn of them, on the GPU: five dispatches for all trees at once,
/// nothing read back. The CPU's twin is foliage/select.h; both choose the same to the bit.
///   Extractor extractor(sites, {});
///   stream...: rows of visible sites
///   extract(extractor, store, {stream.name(), offset, trees});
///   draw_plants(programs, store, extractor, focal_px);          // foliage/gl/draw_plants.h
#include <cstdint>
#include <memory>
#include <span>

#include "foliage/gl/plant_store.h"
#include "foliage/list_bounds.h"
#include "gl/buffer.h"
#include "gl/readback.h"

namespace manzana::foliage {

namespace glsl {
#include "foliage/shaders/extract.glsl"
}  // namespace glsl

/// What a frame may show at most: what is beyond is not drawn, so a budget should keep it from happening
/// (foliage/budget.h, room_of()). Memory: 36 bytes a cell, 8 a group; and 224 a tree.
struct ExtractLimits {
  std::uint32_t cells = 1U << 20;  ///< at most kMostCells
  std::uint32_t quads = 1U << 21, lines = 1U << 18, points = 1U << 21;
};

constexpr std::uint32_t kMostCells = 65535 * 64;  // of one dispatch, on every device

/// Rows of sites, in a buffer of uint; their upper byte says how many 255ths of a tree mosaics show (ldm_select.h).
struct TreesInView {
  GLuint buffer = 0;
  GLintptr offset = 0;
  std::uint32_t trees = 0;
  double error_at_1m = 0.001;    ///< as TreesSeen has it
  bool heed_neighbours = true;   ///< likewise
  ViewSides sides = kAllAround;  ///< likewise
};

/// All plants' sites, and room for what is extracted from them.
struct Extractor {
  /// Throws std::runtime_error when a shader does not compile, or the device has no room.
  Extractor(std::span<const TreeSite> sites, const ExtractLimits& limits);

  std::uint32_t most_trees;
  glsl::Capacity capacity;
  gl::Buffer sites, trees, items, groups, commands, totals;

  std::unique_ptr<gl::Readback> shown;  ///< Totals::shown and missing

  struct Sums {
    gl::Buffer offsets, blocks;
  };
  gl::Buffer counts;  ///< of trees' fixed items
  Sums tree_sums, cell_sums;
  gl::Program place, scan_trees, choose, scan_cells, expand;
};

/// Needs the blocks' rows bound to kBlockRowsBinding. No allocation, no wait.
void extract(Extractor& extractor, const PlantStore& store, const TreesInView& view);

/// The same, each node's trees for themselves: five dispatches a node. `nodes`: runs of sites, those of `view` or
/// parts of them, in order. Records and items are equal to the bit, and so are groups but for their order. For
/// comparison.
void extract_by_node(Extractor& extractor, const PlantStore& store, const TreesInView& view,
                     std::span<const Run> nodes);

/// What was chosen some frames ago, by the newest that the GPU has finished; no wait. Zeros before the first.
Shown newest_shown(Extractor& extractor);

/// Of an extractor's lists.
ListSizes room_of(const glsl::Capacity& capacity);

/// Where commands begin in Extractor::commands, in bytes.
struct CommandPlaces {
  GLintptr quads, lines, points;
};
CommandPlaces command_places(const glsl::Capacity& capacity);

}  // namespace manzana::foliage
