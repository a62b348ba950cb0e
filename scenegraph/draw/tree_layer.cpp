#include "scenegraph/draw/tree_layer.h"

#include <cassert>
#include <stdexcept>

#include "manzana_draw_shaders.h"
#include "scenegraph/draw/shadows.h"

namespace manzana::draw {
namespace {

std::vector<foliage::PreparedPlant> without_pictures(std::span<const foliage::PreparedPlant> plants) {
  if (plants.size() < static_cast<std::size_t>(PlantKind::count)) {
    throw std::invalid_argument("a plant for each PlantKind is needed");
  }
  std::vector<foliage::PreparedPlant> all(plants.begin(), plants.end());
  for (foliage::PreparedPlant& plant : all) plant.leaf_image = plant.bark_image = {};
  return all;
}

/// A site for each tree, in the same order.
std::vector<foliage::TreeSite> sites_of(const TreeLayer& trees, std::span<const foliage::PreparedPlant> plants) {
  std::vector<foliage::TreeSite> sites;
  sites.reserve(trees.instances.size());
  for (const TreeInstance& tree : trees.instances) {
    const auto kind = static_cast<std::uint32_t>(tree.kind);
    foliage::TreeSite& site =
        sites.emplace_back(make_site(plants[kind], kind, tree.height_m, tree.crown_radius_m, tree.yaw, sites.size()));
    site.position = tree.position;
    site.block = tree.block;
    site.hash = (site.hash & ~255U) | tree.tint;
  }
  return sites;
}

foliage::HostShaders host_shaders() {
  using namespace shaders;
  return {.vertex = {frame_layout_glsl, frame_glsl, light_glsl, plant_light_glsl},
          .quads = {frame_layout_glsl, frame_glsl, light_glsl, tree_frag},
          .lines = {frame_layout_glsl, frame_glsl, light_glsl, tree_line_frag},
          .points = {frame_layout_glsl, frame_glsl, light_glsl, tree_point_frag}};
}

/// Runs of rows that follow each other become one. Returns how many there are, and in how many trees.
foliage::TreesInView write_runs(const TreeLayer& trees, std::span<const culling::ObjectRun> objects, glm::uvec2* out) {
  foliage::TreesInView view;
  std::uint32_t end = ~0U;
  for (const culling::ObjectRun& run : objects) {
    const auto [first, last] = trees.table.rows(run);
    if (first == last) continue;
    if (first != end) out[view.runs++] = {first, view.trees};
    view.trees += last - first;
    end = last;
  }
  return view;
}

}  // namespace

TreeLayerGpu::TreeLayerGpu(const TreeLayer& trees, std::span<const foliage::PreparedPlant> prepared)
    : plants(without_pictures(prepared)),
      store(prepared),
      extractor(sites_of(trees, prepared), {}),
      programs(host_shaders()),
      shadows(make_shadow("shadow_tree", shaders::shadow_tree_vert)),
      law(foliage::Law::ours) {
  set_details(store, make_details(plants, law));
}

std::size_t stream_bytes(const TreeLayerGpu&, std::size_t runs) {
  return gl::StreamBuffer::padded(runs * sizeof(glm::uvec2));
}

void extract_trees(TreeLayerGpu& layer, const TreeLayer& trees, std::span<const culling::ObjectRun> objects,
                   const TreeDetail& detail, gl::StreamBuffer& stream) {
  if (layer.law != detail.law) set_details(layer.store, make_details(layer.plants, detail.law));
  layer.law = detail.law;
  const auto runs = stream.take<glm::uvec2>(objects.size());
  foliage::TreesInView view = write_runs(trees, objects, runs.items);
  view.buffer = stream.name();
  view.offset = runs.offset;
  view.error_at_1m = detail.error_at_1m;
  layer.trees_in_view = view.trees;
  if (view.trees > 0) extract(layer.extractor, layer.store, view);
}

Drawn draw_trees(const TreeLayerGpu& layer, const foliage::DrawPlantsOptions& options) {
  if (layer.trees_in_view == 0) return {};
  draw_plants(layer.programs, layer.store, layer.extractor, options);
  return {0, 3};
}

Drawn draw_tree_shadows(const TreeLayerGpu& layer) {
  if (layer.trees_in_view == 0) return {};
  glBindVertexArray(layer.programs.array.name());
  return draw_shadows(layer.shadows, layer.trees_in_view);
}

foliage::Shown newest_shown(TreeLayerGpu& layer) {
  return layer.trees_in_view == 0 ? foliage::Shown{} : newest_shown(layer.extractor);
}

}  // namespace manzana::draw
