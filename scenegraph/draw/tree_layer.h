#pragma once
/// Trees on the GPU: what the culling sees goes to foliage/gl as rows of sites, and comes back as three draws.
#include "foliage/budget.h"
#include "foliage/detail.h"
#include "foliage/gl/draw_plants.h"
#include "scenegraph/draw/far_trees.h"
#include "scenegraph/draw/instances.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::draw {

/// How plants are lit here; they read FrameData (camera.h) from uniform block 0.
foliage::HostShaders plant_shaders();

/// Room in the lists for what is left of all plants however much may be wrong: of those without leaves a few lines.
/// `in_full`: for all detail of all of them at once, as far as a device can have it.
foliage::ExtractLimits limits_for(const Scene& scene, std::span<const foliage::PreparedPlant> plants, bool in_full);

struct TreeLayerGpu {
  /// `plants`: by TreeInstance::plant; those that no tree is may be empty. Throws std::invalid_argument for too few.
  TreeLayerGpu(const Scene& scene, std::span<const foliage::PreparedPlant> plants,
               const foliage::ExtractLimits& limits);

  std::vector<foliage::PreparedPlant> plants;  ///< without pictures: what tables are made from
  foliage::PlantStore store;
  std::shared_ptr<const std::vector<foliage::TreeSite>> sites;
  foliage::Extractor extractor;
  foliage::PlantPrograms programs;
  gl::Program shadows;
  FarTrees far;
  Groves groves;
  struct Tables {
    foliage::Law law = foliage::Law::ours;
    std::vector<foliage::Detail> details;
    foliage::CostTable costs;
  };
  Tables asked, ours;               ///< the second for what the first has no room for, at whatever error
  foliage::Law law;                 ///< of the last extraction: of the store's table
  std::vector<foliage::Run> runs;   ///< of the frame at hand
  double error_at_1m = 0;           ///< of the last extraction, after the budget
  std::uint32_t trees_in_view = 0;  ///< of the last extraction, but for those that groves alone show
  std::uint64_t grove_points = 0;   ///< drawn last
};

struct TreeDetail {
  foliage::Law law = foliage::Law::ours;
  double error_at_1m = 0.001;  ///< error in pixels / focal length in pixels
  double vertices = 0;         ///< a budget that may raise it; 0: none
  bool mosaics = false;        ///< trees that are small are shown by their species' packs, where there are some
  bool groves = false;         ///< blocks whose trees are smaller still are shown as groves, where there are some
  double shadow_at_1m = 0;     ///< TreesToSplit has it
  foliage::ViewSides sides = foliage::kAllAround;
  bool by_node = false;  ///< each visible node's trees in dispatches of their own; else all at once
};

std::size_t stream_bytes(const TreeLayerGpu& layer);
struct TreeBytes {
  std::size_t plants = 0, lists = 0;
};
TreeBytes device_bytes_of(const TreeLayerGpu& layer);

/// Once a frame, with the blocks' rows, relative to the eye, bound. `objects`: runs of the tree's.
void extract_trees(TreeLayerGpu& layer, const TreeLayer& trees, std::span<const culling::ObjectRun> objects,
                   std::span<const Rows> blocks, const TreeDetail& detail, gl::StreamBuffer& stream);
/// Groves' points are not among the triangles.
Drawn draw_trees(TreeLayerGpu& layer, const foliage::DrawPlantsOptions& options);
/// Soft dark ground under the trees, over the surfaces.
Drawn draw_tree_shadows(const TreeLayerGpu& layer);

/// Of the newest frame that the GPU has finished; no wait.
foliage::Shown newest_shown(TreeLayerGpu& layer);

}  // namespace manzana::draw
