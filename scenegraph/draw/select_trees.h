#pragma once
/// Which level each visible tree is drawn with, and where: what later work replaces. Cost: visible trees only.
///   TreeSelection selection(instances.size(), models);
///   count_trees(scene.trees, objects, blocks, pixels, selection); // chooses
///   place_trees(scene.trees, objects, blocks, selection, slots);  // writes, sorted by model and level
#include <span>
#include <vector>

#include "foliage/plant_model.h"
#include "scenegraph/draw/instances.h"
#include "scenegraph/scene.h"

namespace manzana::draw {

/// The meshes of all models, all levels, in one row: level l of kind k is mesh first_mesh[k] + l.
struct TreeSelection {
  TreeSelection(std::size_t trees, std::span<const foliage::PlantModel> models);
  std::span<const foliage::PlantModel> models;  ///< the caller's
  std::vector<std::size_t> first_mesh;
  InstanceBins bins;
  std::vector<std::uint16_t> mesh_of;  ///< of each visible tree, in the order of the runs
};

/// `objects`: runs of the tree's. `blocks`: relative to the eye, valid for visible blocks. `focal_px`:
/// culling::projected_radius's, times the detail.
void count_trees(const TreeLayer& trees, std::span<const culling::ObjectRun> objects, std::span<const Rows> blocks,
                 double focal_px, TreeSelection& selection);
void place_trees(const TreeLayer& trees, std::span<const culling::ObjectRun> objects, std::span<const Rows> blocks,
                 TreeSelection& selection, Instance* slots);

}  // namespace manzana::draw
