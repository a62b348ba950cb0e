#pragma once
/// Prepared plants on the GPU: one buffer for each kind of thing, all plants in it, and one array of pictures.
///   PlantStore store(plants);                       // once
///   set_details(store, make_details(plants, Law::ours));  // foliage/detail.h
#include <span>

#include "foliage/select.h"
#include "gl/handle.h"

namespace manzana::foliage {

struct PlantStore {
  /// Throws std::runtime_error when the device has no room, std::invalid_argument as make_plant_table does.
  explicit PlantStore(std::span<const PreparedPlant> prepared);

  PlantTable table;  ///< what the CPU's twin asks
  gl::Buffer plants, cells, steps, details, views;
  gl::Buffer quads, lines, points;
  gl::Texture images;  ///< layers 2 k: bark of plant k, 2 k + 1: its leaf; with mip levels
};

void set_details(PlantStore& store, std::vector<Detail> details);

/// To their bindings, for extraction and drawing.
void bind(const PlantStore& store);

/// Names of the bindings of foliage/shaders; a host keeps 1 for its blocks' rows, 2 for its sites.
enum Binding : GLuint {
  kBlockRowsBinding = 1,
  kSitesBinding,
  kPlantsBinding,
  kCellsBinding,
  kDetailsBinding,
  kViewsBinding,
  kSitesInViewBinding,
  kTotalsBinding,
  kTreesBinding,
  kOffsetsBinding,
  kBlocksBinding,
  kCommandsBinding,
  kTreeOffsetsBinding,
  kTreeBlocksBinding,
  kItemsBinding,
  kGroupsBinding,
  kPrimitivesBinding,
  kStepsBinding,
  kItemCountsBinding
};

}  // namespace manzana::foliage
