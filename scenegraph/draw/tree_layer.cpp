#include "scenegraph/draw/tree_layer.h"

#include <cassert>
#include <cmath>
#include <stdexcept>

#include "manzana_draw_shaders.h"
#include "scenegraph/draw/shadows.h"
#include "scenegraph/tree_sites.h"

namespace manzana::draw {
namespace {

std::vector<foliage::PreparedPlant> without_pictures(std::span<const foliage::PreparedPlant> plants) {
  std::vector<foliage::PreparedPlant> all;
  all.reserve(plants.size());
  for (const foliage::PreparedPlant& plant : plants) {
    all.push_back(plant);
    all.back().leaf_image = all.back().bark_image = {};
  }
  return all;
}

/// The sources' laws know no neighbours.
bool heeds_neighbours(foliage::Law law) { return law == foliage::Law::ours; }

TreeLayerGpu::Tables make_tables(TreeLayerGpu& layer, foliage::Law law) {
  set_details(layer.store, make_details(layer.plants, law));
  layer.law = law;
  return {law, layer.store.table.details, make_costs(layer.store.table)};
}

void use(TreeLayerGpu& layer, const TreeLayerGpu::Tables& tables) {
  if (layer.law != tables.law) set_details(layer.store, tables.details);
  layer.law = tables.law;
}

/// The law that is asked for if the lists have room for it at any error; else ours, which shows less and less.
void choose_detail(TreeLayerGpu& layer, std::span<const Vec4> rows, const TreeDetail& detail) {
  constexpr double kGreatestError = 1e6;  // metres a metre away
  if (layer.asked.law != detail.law) layer.asked = make_tables(layer, detail.law);
  const foliage::Budget budget{.vertices = detail.vertices, .room = foliage::room_of(layer.extractor.capacity)};
  const auto error_with = [&](TreeLayerGpu::Tables& tables) {
    const foliage::TreesSeen seen{*layer.sites, rows, layer.far.near, detail.error_at_1m, heeds_neighbours(tables.law)};
    return error_for(tables.costs, layer.store.table, seen, budget);
  };
  TreeLayerGpu::Tables* tables = &layer.asked;
  layer.error_at_1m = error_with(*tables);
  if (!std::isfinite(layer.error_at_1m)) {
    tables = &layer.ours;
    layer.error_at_1m = std::min(kGreatestError, error_with(*tables));
  }
  use(layer, *tables);
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

foliage::TreesInView write_rows(TreeLayerGpu& layer, std::span<const Vec4> rows, const TreeDetail& detail,
                                gl::StreamBuffer& stream) {
  const auto out = stream.take<GLuint>(layer.sites->size());
  const foliage::TreesSeen seen{*layer.sites, rows, layer.runs, detail.error_at_1m};
  begin_frame(layer.groves);
  Groves* groves = detail.mosaics && detail.groves ? &layer.groves : nullptr;
  const std::uint32_t trees = split_trees(
      layer.far, {layer.store.table, seen, detail.mosaics ? kAllMosaics : 0, groves, detail.shadow_at_1m}, out.items);
  end_frame(layer.groves);
  return {.buffer = stream.name(), .offset = out.offset, .trees = trees};
}

}  // namespace

foliage::HostShaders plant_shaders() {
  using namespace shaders;
  return {.vertex = {frame_layout_glsl, frame_glsl, light_glsl, plant_light_glsl},
          .quads = {frame_layout_glsl, frame_glsl, light_glsl, tree_frag},
          .lines = {frame_layout_glsl, frame_glsl, light_glsl, tree_line_frag},
          .points = {frame_layout_glsl, frame_glsl, light_glsl, tree_point_frag},
          .mosaics = {frame_layout_glsl, frame_glsl, light_glsl, plant_light_glsl, tree_mosaic_frag}};
}

namespace {

std::size_t coarsest_lines(const foliage::PreparedPlant& plant) {
  return plant.line_levels.empty() ? plant.lines.size() : plant.line_levels.back().lines.size();
}

}  // namespace

foliage::ExtractLimits limits_for(const Scene& scene, std::span<const foliage::PreparedPlant> plants, bool in_full) {
  constexpr std::uint64_t kMostQuads = 1U << 26, kMostLines = 1U << 26;  // 128 MB of groups
  std::uint64_t cells = 0, quads = 0, lines = 0;
  for (const TreeInstance& tree : scene.trees.instances) {
    if (tree.plant >= plants.size()) continue;  // which the layer does not accept
    const foliage::PreparedPlant& plant = plants[tree.plant];
    if (plant.leaves.empty()) lines += coarsest_lines(plant) + foliage::glsl::kLineGroup - 1;
    cells += plant.cells.size();
    quads += plant.bark.size() + plant.leaves.size() +
             foliage::glsl::kQuadGroup * (plant.cells.size() + foliage::glsl::kFixedItems);
  }
  foliage::ExtractLimits limits;
  limits.lines = static_cast<std::uint32_t>(std::min(limits.lines + lines, kMostLines));
  if (!in_full) return limits;
  limits.cells = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(cells, limits.cells, foliage::kMostCells));
  limits.quads = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(quads, limits.quads, kMostQuads));
  return limits;
}

TreeLayerGpu::TreeLayerGpu(const Scene& scene, std::span<const foliage::PreparedPlant> prepared,
                           const foliage::ExtractLimits& limits)
    : plants(without_pictures(prepared)),
      store(prepared),
      sites(std::make_shared<const std::vector<foliage::TreeSite>>(tree_sites(scene, prepared))),
      extractor(*sites, limits),
      programs(plant_shaders()),
      shadows(make_shadow("shadow_tree", shaders::shadow_tree_vert)),
      far(plants.size(), plant_shaders()),
      groves(prepared, *sites, scene.blocks.size(), plant_shaders()) {
  if (sites->size() > 1U << foliage::glsl::kShareShift) throw std::runtime_error("more trees than can be drawn");
  asked = ours = make_tables(*this, foliage::Law::ours);
  runs.reserve(sites->size());
}

std::size_t stream_bytes(const TreeLayerGpu& layer) {
  return gl::StreamBuffer::padded(layer.sites->size() * sizeof(GLuint));
}

TreeBytes device_bytes_of(const TreeLayerGpu& layer) {
  constexpr std::size_t kImageBytes = 256 * 256 * 4 * 4 / 3;  // with its smaller levels
  const foliage::PlantStore& store = layer.store;
  const foliage::Extractor& e = layer.extractor;
  const auto sum = [](std::initializer_list<const gl::Buffer*> buffers) {
    std::size_t bytes = 0;
    for (const gl::Buffer* buffer : buffers) bytes += gl::bytes_of(*buffer);
    return bytes;
  };
  return {2 * layer.plants.size() * kImageBytes + sum({&store.plants, &store.cells, &store.steps, &store.details,
                                                       &store.views, &store.quads, &store.lines, &store.points}),
          sum({&e.sites, &e.trees, &e.items, &e.groups, &e.commands})};
}

void extract_trees(TreeLayerGpu& layer, const TreeLayer& trees, std::span<const culling::ObjectRun> objects,
                   std::span<const Rows> blocks, const TreeDetail& detail, gl::StreamBuffer& stream) {
  find_runs(trees, objects, detail.by_node, layer.runs);
  const std::span<const Vec4> rows(blocks.empty() ? nullptr : blocks.front().data(), blocks.size() * 3);
  foliage::TreesInView view = write_rows(layer, rows, detail, stream);
  choose_detail(layer, rows, detail);
  view.error_at_1m = layer.error_at_1m;
  view.heed_neighbours = heeds_neighbours(layer.law);
  view.sides = detail.sides;
  layer.trees_in_view = view.trees;
  if (view.trees == 0) return;
  if (detail.by_node)
    extract_by_node(layer.extractor, layer.store, view, layer.runs);
  else
    extract(layer.extractor, layer.store, view);
}

Drawn draw_trees(TreeLayerGpu& layer, const foliage::DrawPlantsOptions& options) {
  Drawn drawn;
  if (layer.trees_in_view > 0) {
    draw_plants(layer.programs, layer.store, layer.extractor, options);
    drawn = {2 * draw_far_trees(layer.far, options.samples, options.wind), 3};
  }
  layer.grove_points = draw_groves(layer.groves, options.focal_px, options.samples);
  return drawn;
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
