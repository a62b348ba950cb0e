#pragma once
/// What stands in a pixel: a pass of numbers, drawn only when somebody asks.
#include "scenegraph/draw/city_meshes.h"
#include "scenegraph/draw/node_layer.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

struct Pickable {
  const Scene& scene;
  const VisibleSets& sets;
  const CityMeshes& meshes;
  const NodeLayerGpu& nodes;
  std::span<const SeenNode> seen;
};

struct PickPrograms {
  PickPrograms();
  gl::Program meshes, trees, nodes;
};

/// As Renderer::pick has it. A framebuffer of the rectangle's size is made and goes again.
std::vector<std::uint32_t> pick_objects(const PickPrograms& programs, const Pickable& what, const Camera& camera,
                                        Size picture, const PixelRect& rect);

}  // namespace manzana::draw
