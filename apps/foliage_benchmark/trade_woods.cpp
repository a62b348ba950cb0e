// A wood from afar, by each knob of mosaics and groves.
#include <algorithm>

#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/trade.h"
#include "scenegraph/draw/renderer.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::PreparedPlant;

double mean_height(std::span<const PreparedPlant> plants) {
  double sum = 0;
  for (const PreparedPlant& plant : plants) sum += static_cast<double>(plant.height_m);
  return sum / static_cast<double>(plants.size());
}

/// None of it, and the walkthrough's knobs: that of mosaics changed alone, those of groves by all pairs.
std::vector<Setting> settings_of(bool quick) {
  using Values = std::vector<double>;
  const double error_px = draw::quality_named("balanced").tree_error_px;
  const FarKnobs usual;
  std::vector<Setting> settings{{foliage::Law::ours, error_px}};
  const auto add = [&](const FarKnobs& knobs) {
    const auto known = [&](const Setting& setting) { return setting.far == knobs; };
    if (std::ranges::none_of(settings, known)) settings.push_back({foliage::Law::ours, error_px, knobs});
  };
  for (const double mosaics : quick ? Values{0, 24, 48} : Values{0, 16, 24, 32, 40, 48, 64})
    add({mosaics, usual.groves});
  for (const double all : quick ? Values{0, 10, 16} : Values{0, 3, 5, 7, 10, 14})
    for (const double points : all == 0 ? Values{usual.groves.points}
                               : quick  ? Values{0.7, 1.4}
                                        : Values{0.35, 0.7, 1.4})
      add({usual.mosaics, {all, points}});
  return settings;
}

}  // namespace

ErrorPlan wood_plan(bool quick) {
  ErrorPlan plan{.heights = {48, 32, 24, 16, 8, 4}, .settings = settings_of(quick), .product = false};
  if (!quick) return plan;
  plan.heights = {24, 6};
  plan.views = 3;
  plan.mode = "quick";
  return plan;
}

std::vector<foliage::TreeSite> make_wood(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  return make_forest(plants, plan.wood_trees, closed_spacing(plants), 7);
}

Extent extent_of_wood(std::span<const PreparedPlant> plants, std::span<const foliage::TreeSite> sites) {
  const std::vector<Extent> extents = extents_of(plants);
  Extent wood;
  wood.nominal_height = mean_height(plants);
  for (const foliage::TreeSite& site : sites) {
    const Extent& extent = extents[site.plant];
    wood.low = std::min(wood.low, extent.low * static_cast<double>(site.height));
    wood.high = std::max(wood.high, extent.high * static_cast<double>(site.height));
    wood.radius =
        std::max(wood.radius, glm::length(Vec2d(site.position)) + extent.radius * static_cast<double>(site.radius));
  }
  return wood;
}

std::vector<Motif> wood_motifs(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  const Extent extent = extent_of_wood(plants, make_wood(plants, plan));
  const auto all = [&](std::uint32_t) { return foliage::Run{0, plan.wood_trees}; };
  std::vector<Motif> motifs;
  for (const double height_px : plan.far.heights)
    motifs.push_back(motif_of(kWood, extent, all, height_px, plan.far.views));
  return motifs;
}

}  // namespace manzana::foliage_benchmark
