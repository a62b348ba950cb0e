#pragma once
/// One tree's leaves as an explicit list of indices, for comparison with extraction. [Gumbau 2009: a level of detail
/// for each cell, sums of what cells keep, a pass that writes the indices, one draw] Too large for forests: 24 bytes a
/// quad of each tree, where a group of four quads has 8.
///   IndexList list(store, plant);                       // once
///   write_list(list, store, lods);                      // a level of detail for each cell, in [0, 1]
///   glUseProgram(...); draw_list(list);                 // quad gl_VertexID / 4 of the store, corner gl_VertexID % 4
#include <span>

#include "foliage/gl/plant_store.h"

namespace manzana::foliage {

struct IndexList {
  /// Room for all leaves of one of the store's plants. Throws std::runtime_error as Extractor does.
  IndexList(const PlantStore& store, std::uint32_t plant);

  std::uint32_t first_cell, cells, first_quad;
  gl::Buffer lods, offsets, command, indices;
  gl::Program count, write;
  gl::VertexArray array;
};

/// Of each cell the first floor(n lod) leaves (kept() of foliage/lod_factor.h), cell after cell. No wait.
void write_list(IndexList& list, const PlantStore& store, std::span<const float> lods);

/// One indexed indirect draw, by the program in use.
void draw_list(const IndexList& list);

}  // namespace manzana::foliage
