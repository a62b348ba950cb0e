#include "apps/foliage_benchmark/trade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/forest.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;
using foliage::PreparedPlant;

constexpr std::array kLaws{Law::ours, Law::prune, Law::ramp, Law::points_and_lines, Law::levels};

std::vector<Setting> settings_of(bool quick) {
  std::vector<double> ours{0.25, 0.35, 0.5, 0.85, 1, 1.4, 2, 4}, others{1};
  if (!quick) ours = {0.25, 0.35, 0.5, 0.7, 0.85, 1, 1.2, 1.4, 2, 2.8, 4, 8}, others = {0.5, 1, 2, 4};
  std::vector<Setting> settings;
  for (const Law law : kLaws)
    for (const double error : law == Law::ours ? ours : others) settings.push_back({law, error});
  return settings;
}

double half_side(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  return closed_spacing(plants) * std::sqrt(plan.stand_trees) / 2;
}

/// Where the eye stands, in halves of the stand's side and heights of its trees, and how far it looks down.
struct Place {
  const char* name;
  double away, up, down;
};
constexpr std::array<Place, 3> kPlaces{
    {{"stand, its edge", 2.2, 0.1, 0.0}, {"stand, inside", 0.2, 0.1, -0.2}, {"stand, above", 2.2, 5, 0.9}}};

/// One side, with the trees of all.
std::vector<foliage::Run> all_runs(const Motif& motif) {
  std::vector<foliage::Run> runs;
  for (const Sight& sight : motif.sights) runs.insert(runs.end(), sight.runs.begin(), sight.runs.end());
  return runs;
}

void add_costs(const Effort& effort, const std::vector<Motif>& motifs, bool all_sides, const TradePlan& plan,
               Lazy<Stage>& stage, Times& times) {
  for (const Motif& motif : motifs)
    for (const Setting& setting : plan.errors.settings)
      times.add({.table = kTradeTable,
                 .plant = motif.name,
                 .way = cost_key(name_of(setting.law), setting.error_px, motif.height_px),
                 .reference = "all detail"},
                [&](TimeRow& row) {
                  const Sight& sight = motif.sights.front();
                  const auto runs = all_sides ? all_runs(motif) : sight.runs;
                  const auto draw = [&](const Setting& w) {
                    stage->set_law(w.law);
                    stage->draw_only(runs, sight.shot, {w.error_px, Sampling::product});
                  };
                  row.error_px = setting.error_px;
                  row.trees = trees_of(runs);
                  set_times(time_pairs([&] { draw(setting); }, [&] { draw({Law::full}); }, effort.seconds() / 5, 1),
                            row);
                });
}

}  // namespace

std::string cost_key(std::string_view law, double error_px, double height_px) {
  return std::string(law) + " " + apps::digits3(error_px) + " px, " + apps::digits3(height_px) + " px high";
}

TradePlan trade_plan(bool quick) {
  TradePlan plan;
  plan.errors.settings = settings_of(quick);
  plan.errors.mode = quick ? "quick" : "full";
  if (!quick) return plan;
  plan.errors.heights = {96, 24};
  plan.errors.views = 3;
  plan.errors.product = false;
  plan.stand_trees = 16;
  plan.stand_rows = 120;
  return plan;
}

std::vector<foliage::TreeSite> make_stand(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  return make_forest(plants, plan.stand_trees, closed_spacing(plants), 5);
}

std::uint64_t stand_bark(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  std::uint64_t quads = 0;
  for (const foliage::TreeSite& site : make_stand(plants, plan)) {
    const PreparedPlant& plant = plants[site.plant];
    quads += plant.branch_levels.empty() ? 0 : plant.branch_levels.front().quads.size();
  }
  return quads;
}

std::vector<Motif> stand_motifs(std::span<const PreparedPlant> plants, const TradePlan& plan) {
  const double half = half_side(plants, plan), height = static_cast<double>(plants.front().height_m);
  std::vector<Motif> motifs;
  for (const Place& place : kPlaces) {
    Motif motif{place.name, 0, {}};
    for (int view = 0; view < plan.errors.views; ++view) {
      const double azimuth = 2 * std::numbers::pi * view / plan.errors.views;
      const Vec3d out(std::cos(azimuth), std::sin(azimuth), 0);
      const Vec3d eye = out * (place.away * half) + Vec3d(0, 0, place.up * height);
      Sight sight{screen_shot(eye, -out - Vec3d(0, 0, place.down), plan.stand_rows), {{0, plan.stand_trees}}, 0, 0};
      sight.azimuth_deg = 360.0 * view / plan.errors.views;
      motif.height_px = std::round(sight.shot.focal_px * height / std::max(glm::length(eye), half));
      sight.shot.fine = fine_samples(motif.height_px, sight.shot.width);
      motif.sights.push_back(std::move(sight));
    }
    motifs.push_back(std::move(motif));
  }
  return motifs;
}

std::vector<ErrorRow> measure_trade(std::span<const PreparedPlant> plants, const TradePlan& plan,
                                    const std::function<void(double)>& progress, apps::Record<ErrorRow>& record) {
  constexpr double kShareOfPlants = 0.6;
  auto rows = measure_errors(
      plants, plan.errors, [&](double done) { progress(kShareOfPlants * done); }, &record);
  Stage stage(plants, make_stand(plants, plan));
  const auto more = measure_errors(
      stage, stand_motifs(plants, plan), plan.errors,
      [&](double done) { progress(kShareOfPlants + (1 - kShareOfPlants) * done); }, &record);
  rows.insert(rows.end(), more.begin(), more.end());
  return rows;
}

void add_trade_costs(const Effort& effort, std::span<const PreparedPlant> plants, const TradePlan& plan, Times& times) {
  const auto copies = static_cast<std::uint32_t>(plan.errors.views);
  Lazy<Stage> alone([&] { return Stage(plants, sites_of(plants, copies)); });
  add_costs(effort, motifs_of(plants, plan.errors), true, plan, alone, times);
  Lazy<Stage> stand([&] { return Stage(plants, make_stand(plants, plan)); });
  add_costs(effort, stand_motifs(plants, plan), false, plan, stand, times);
}

}  // namespace manzana::foliage_benchmark
