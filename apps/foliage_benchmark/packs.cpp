#include "apps/foliage_benchmark/packs.h"

#include "scenegraph/draw/tree_layer.h"

namespace manzana::foliage_benchmark {

Packs::Packs(std::vector<foliage::LdmPack> packs)
    : packs_(std::move(packs)),
      drawer_(packs_, std::make_shared<foliage::LdmPrograms>(shaders_with_mask(), draw::plant_shaders())) {}

Paint Packs::painter(const Stage& stage, std::span<const foliage::Run> runs, const Shot& shot, Way way) {
  return [this, &stage, runs, &shot, way](const Canvas& canvas) {
    const auto rows = rows_seen_from(shot.view.eye);
    // Detail is that of the screen, however finely it is sampled.
    choose_ldm(drawer_.store().table, {stage.sites(), rows, runs, shot.focal_px}, way == Way::blended, chosen_);
    if (way == Way::dithered)
      drawer_.draw_dithered(chosen_, canvas.samples);
    else
      drawer_.draw_blended(chosen_, canvas.width, canvas.height);
  };
}

}  // namespace manzana::foliage_benchmark
