#pragma once
/// Trees on the GPU: meshes and textures of all models resident, visible instances written each frame.
#include "gl/program.h"
#include "scenegraph/draw/select_trees.h"

namespace manzana::draw {

struct TreeLayerGpu {
  TreeLayerGpu(std::size_t trees, std::span<const foliage::PlantModel> plants, const Quality& quality);
  std::vector<foliage::PlantModel> models;  ///< one a kind, without vertices and images: what selection asks
  TreeSelection selection;
  MeshSet meshes;
  gl::Texture textures;  ///< layers 2 k: bark of kind k, 2 k + 1: its leaf
  gl::Program program;
};

Drawn draw_trees(TreeLayerGpu& layer, const TreeLayer& trees, std::span<const culling::ObjectRun> objects,
                 std::span<const Rows> blocks, gl::StreamBuffer& stream, bool alpha_to_coverage);

}  // namespace manzana::draw
