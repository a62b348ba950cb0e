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

void set_law(TreeLayerGpu& layer, foliage::Law law) {
  set_details(layer.store, make_details(layer.plants, law));
  layer.costs = make_costs(layer.store.table);
  layer.law = law;
}

/// Rows of the layer, in order; those that follow each other become one run, unless nodes are wanted apart.
void find_runs(const TreeLayer& trees, std::span<const culling::ObjectRun> objects, bool apart,
               std::vector<foliage::Run>& runs) {
  runs.clear();
  for (const culling::ObjectRun& run : objects) {
    const auto [first, last] = trees.table.rows(run);
    if (first == last) continue;
    if (!apart && !runs.empty() && runs.back().last == first)
      runs.back().last = last;
    else
      runs.push_back({first, last});
  }
}

foliage::TreesInView write_runs(std::span<const foliage::Run> runs, gl::StreamBuffer& stream) {
  const auto out = stream.take<glm::uvec2>(runs.size());
  foliage::TreesInView view{.buffer = stream.name(), .offset = out.offset};
  for (const foliage::Run& run : runs) {
    out.items[view.runs++] = {run.first, view.trees};
    view.trees += run.size();
  }
  return view;
}

}  // namespace

foliage::HostShaders plant_shaders() {
  using namespace shaders;
  return {.vertex = {frame_layout_glsl, frame_glsl, light_glsl, plant_light_glsl},
          .quads = {frame_layout_glsl, frame_glsl, light_glsl, tree_frag},
          .lines = {frame_layout_glsl, frame_glsl, light_glsl, tree_line_frag},
          .points = {frame_layout_glsl, frame_glsl, light_glsl, tree_point_frag}};
}

TreeLayerGpu::TreeLayerGpu(const TreeLayer& trees, std::span<const foliage::PreparedPlant> prepared)
    : plants(without_pictures(prepared)),
      store(prepared),
      sites(sites_of(trees, prepared)),
      extractor(sites, {}),
      programs(plant_shaders()),
      shadows(make_shadow("shadow_tree", shaders::shadow_tree_vert)) {
  set_law(*this, foliage::Law::ours);
  runs.reserve(sites.size());
}

std::size_t stream_bytes(const TreeLayerGpu&, std::size_t runs) {
  return gl::StreamBuffer::padded(runs * sizeof(glm::uvec2));
}

void extract_trees(TreeLayerGpu& layer, const TreeLayer& trees, std::span<const culling::ObjectRun> objects,
                   std::span<const Rows> blocks, const TreeDetail& detail, gl::StreamBuffer& stream) {
  if (layer.law != detail.law) set_law(layer, detail.law);
  find_runs(trees, objects, detail.by_node, layer.runs);
  const std::span<const Vec4> rows(blocks.empty() ? nullptr : blocks.front().data(), blocks.size() * 3);
  const foliage::TreesSeen seen{layer.sites, rows, layer.runs, detail.error_at_1m};
  layer.error_at_1m = error_for(layer.costs, layer.store.table, seen, {.vertices = detail.vertices});
  foliage::TreesInView view = write_runs(layer.runs, stream);
  view.error_at_1m = layer.error_at_1m;
  layer.trees_in_view = view.trees;
  if (view.trees == 0) return;
  if (detail.by_node)
    extract_by_node(layer.extractor, layer.store, view, layer.runs);
  else
    extract(layer.extractor, layer.store, view);
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
